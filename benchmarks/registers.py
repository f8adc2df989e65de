"""How fast is `tw.fast` where the processor's registers are shorter? The same processor, told to use half of them.

python benchmarks/registers.py            # five minutes; writes results/registers.csv, for tables.py

Each width is a process of its own, and the two take turns. With 256 bits LLVM also has only the instructions that
processors with such registers have (AVX2 with fma), and no more of the registers.
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import csv
import json
import subprocess
import sys
from unittest.mock import patch

import numpy as np
from study.speed import speed
from tables import HERE

import twistwrench as tw
from straightline import llvm as ours

WIDTHS = (512, 256)
TURNS = 5
RESULTS = HERE / "results" / "registers.csv"


def measured(bits: int) -> dict[str, float]:
    """Return the ratio to Pinocchio's loop of each quantity in a batch of 1000, on a processor with such registers."""
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features()
    if bits < 512:
        features.update((name, False) for name in features if "avx512" in name)
    cpu = llvm.get_host_cpu_name() if bits == 512 else "haswell"
    with (
        patch.object(llvm, "get_host_cpu_features", lambda: features),
        patch.object(llvm, "get_host_cpu_name", lambda: cpu),
    ):
        if ours.register_bits() != bits:
            raise SystemExit(f"this processor has registers of {ours.register_bits()} bits, not {bits}")
        found = speed(tw.load("go2"))
        theirs = {r.quantity: r.seconds for r in found if r.way == "Pinocchio"}
        many = [r for r in found if r.way == "fast" and r.states > 1]
        return {f"{r.quantity}, {r.number}": r.seconds / theirs[r.quantity] for r in many}


def main() -> None:
    """Let the widths take turns, each in a process of its own, and write medians and quartiles."""
    if len(sys.argv) > 1:
        print(json.dumps(measured(int(sys.argv[1]))))
        return
    found: dict[tuple[str, int], list[float]] = {}
    for _ in range(TURNS):
        for bits in WIDTHS:
            text = subprocess.run(
                [sys.executable, __file__, str(bits)], check=True, capture_output=True, text=True
            ).stdout
            for name, ratio in json.loads(text.splitlines()[-1]).items():
                found.setdefault((name, bits), []).append(ratio)
    with RESULTS.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["quantity", "bits", "ratio", "ratio_q1", "ratio_q3"])
        for (name, bits), ratios in found.items():
            writer.writerow([name, bits, *(f"{x:.4g}" for x in np.quantile(ratios, [0.5, 0.25, 0.75]))])


if __name__ == "__main__":
    main()

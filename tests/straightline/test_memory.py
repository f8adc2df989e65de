"""Memory of results is used again: the pages that the kernel has to hand out anew are counted."""

import platform
import subprocess
import sys

import pytest

FAULTS = """
import resource
import numpy as np
import twistwrench as tw
from straightline import backend

if {dropped}:
    backend.keep_memory = lambda: None
model = tw.load("go2")
program = tw.compile(model, ["M", "h", "J_c", "A_G"], backend="numpy")
q, v = np.tile(model.standing(), (1000, 1)), np.zeros((1000, model.nv))
counts = []
for _ in range(6):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    program(q, v)
    counts.append(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
print(counts[-1])
"""


def page_faults(dropped):
    code = FAULTS.format(dropped=dropped)
    return int(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)


@pytest.mark.slow
@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another C library keeps memory in its own way")
def test_a_batch_uses_the_memory_of_the_last_one_again():
    without = page_faults(True)
    if without < 100:
        pytest.skip("the C library keeps the memory by itself, or the kernel does not count")
    assert page_faults(False) < without / 5

"""What docs/dask.md says works: its program, in two processes, with the results of the single call."""

import re
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

PROGRAM = re.search(
    r"```python\n(.*?)```", (Path(__file__).parents[2] / "docs" / "dask.md").read_text(encoding="utf-8"), re.DOTALL
)[1]


@pytest.fixture(scope="module")
def client():
    """Two processes with one thread each, and no window on them."""
    pytest.importorskip("dask.array", reason="Dask is not installed: more than one machine is not tried")
    distributed = pytest.importorskip("distributed", reason="Dask's scheduler is not installed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


@pytest.mark.slow
def test_the_program_of_the_manual_gives_what_one_process_gives(client):
    names = {"__name__": "program"}
    exec(compile(PROGRAM, "docs/dask.md", "exec"), names)
    largest, power = names["main"](shares=3)
    alone = [names["share"](seed) for seed in range(3)]
    np.testing.assert_array_equal(largest, np.max([torque for torque, _ in alone], axis=0))
    np.testing.assert_allclose(power, np.mean([mean for _, mean in alone]), rtol=1e-12)

    model, rng = tw.load("go2"), np.random.default_rng(7)  # and a share against the textbook
    q = model.integrate(model.standing(), 0.3 * rng.standard_normal((5, model.nv)))
    v, a = rng.standard_normal((2, 5, model.nv))
    tau = tw.rnea(model, q, v, a)
    largest, power = names["share"](7, blocks=1, block=5)
    np.testing.assert_allclose(largest, np.abs(tau[:, 6:]).max(axis=0), rtol=1e-12)
    np.testing.assert_allclose(power, (tau * v).sum(axis=1).mean(), rtol=1e-11)


@pytest.mark.slow
def test_the_work_is_done_in_two_processes(client):
    """Blocks of it in both, none of it here."""
    import os

    import dask.array as da

    model = tw.load("go2")
    q = da.from_array(np.tile(model.standing(), (400, 1)), chunks=(50, -1))

    def who(q):
        return np.full(len(q), os.getpid()), tw.fast.crba(model, q)[:, 0, 0]

    workers, _ = da.compute(*da.apply_gufunc(who, "(q)->(),()", q, output_dtypes=(int, float)))
    assert len(set(workers.tolist())) == 2
    assert os.getpid() not in workers

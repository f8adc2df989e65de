"""What docs/dask.md says works: its program, in two processes, with the results of the single call."""

import re
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

pytest.importorskip("dask.array", reason="Dask is not installed: more than one machine is not tried")
distributed = pytest.importorskip("distributed", reason="Dask's scheduler is not installed")

PROGRAM = re.search(
    r"```python\n(.*?)```", (Path(__file__).parents[2] / "docs" / "dask.md").read_text(encoding="utf-8"), re.DOTALL
)[1]


@pytest.fixture(scope="module")
def client():
    """Two processes with one thread each, and no window on them."""
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


@pytest.mark.slow
def test_the_program_of_the_manual_gives_what_a_single_call_gives(client):
    names = {"__name__": "program"}
    exec(compile(PROGRAM, "docs/dask.md", "exec"), names)
    power, energy, tau, M, h = names["main"](states=2000, block=300)

    model = tw.load("go2")
    rng = np.random.default_rng(0)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(2000)])
    v = rng.standard_normal((2000, model.nv))
    whole = tw.fast.rnea(model, q, v, v)
    d = tw.fast.dynamics(model, q, v, want={"M", "h"})
    for ours, right in ((tau, whole[:5]), (M, d.M[:5]), (h, d.h[:5])):
        np.testing.assert_allclose(ours, right, rtol=0, atol=1e-13 * np.abs(right).max())
    np.testing.assert_allclose(power, (whole * v).sum(-1).mean(), rtol=1e-11)
    np.testing.assert_allclose(energy, tw.kinetic_energy(model, q, v).max(), rtol=1e-13)


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

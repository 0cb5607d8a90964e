"""Sweeps: here and on workers, what fails, what goes on."""

import os
import random
import signal
import threading

import numpy as np
import ppum
import pytest
from conftest import plate


def made(length, load):
    problem = plate((6, 12)).crack((-0.8, -1.2), (-0.8 + length, -1.2))
    # without equilibrium: nothing holds the plate
    return problem.add("boundary", on="left", traction=(load, 0)) if load else problem


CASES = {"length": [0.3, 0.5, 0.7], "load": [0.0, 1.0]}


@pytest.fixture(scope="module")
def expected():
    return ppum.sweep(made, **CASES).run()


def test_here(expected):
    assert dict(expected.sizes) == {"length": 3, "load": 2, "tip": 4}
    single = ppum.solve(made(0.5, 0.0))
    found = expected.sel(length=0.5, load=0.0)
    assert found.k1.values.tolist() == [tip.k1 for tip in single.tips]
    assert found.x.values.tolist() == [tip.xy[0] for tip in single.tips]
    assert int(found.unknowns) == single.steps[0].unknowns and str(found.status.values) == ""
    failed = expected.sel(load=1.0)
    assert np.isnan(failed.k1).all() and all("SolveError" in s for s in failed.status.values)
    assert expected.to_dataframe().shape[0] == 24


def test_goes_on(expected, tmp_path):
    cases = ppum.sweep(made, **CASES)
    assert len(cases) == 6 and "length 3" in repr(cases)
    told = []

    def stop(done, total):
        told.append((done, total))
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        cases.run(save=tmp_path, progress=stop)
    assert told == [(1, 6), (2, 6), (3, 6)]
    files = sorted(tmp_path.iterdir())
    assert len(files) == 2
    times = [file.stat().st_mtime_ns for file in files]
    result = cases.run(save=tmp_path)
    assert result.identical(expected)
    assert [file.stat().st_mtime_ns for file in files] == times and len(list(tmp_path.iterdir())) == 3


def test_names_of_results_are_taken():
    with pytest.raises(ValueError, match="k1"):
        ppum.sweep(made, k1=[1])
    with pytest.raises(ValueError):
        ppum.sweep(made)


@pytest.fixture
def client():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as found:
            yield found


def test_on_workers(client, expected, tmp_path):
    told = []
    result = ppum.sweep(made, **CASES).run(client, threads=1, save=tmp_path, progress=lambda *p: told.append(p))
    assert result.identical(expected) and told[-1] == (6, 6)
    assert len(list(tmp_path.iterdir())) == 3


def kill_one(client, chance):
    """Kills a worker's process as the system would."""
    worker = chance.choice(sorted(client.cluster.workers.values(), key=lambda worker: str(worker.name)))
    if (process := worker.process) is not None and process.pid:
        os.kill(process.pid, signal.SIGKILL)


#: How often a worker is killed at a random moment; PPUM_KILLS=20 for more than is done each time.
KILLS = int(os.environ.get("PPUM_KILLS", 2))


@pytest.mark.parametrize("seed", range(KILLS))
def test_a_worker_that_is_killed_loses_nothing(client, expected, seed):
    chance = random.Random(seed)
    killer = threading.Timer(chance.uniform(0.0, 1.5), kill_one, (client, chance))
    killer.start()  # the sweep takes longer
    told = []
    result = ppum.sweep(made, **CASES).run(client, threads=1, progress=lambda *p: told.append(p))
    killer.join()
    assert result.identical(expected) and [done for done, _ in told] == list(range(1, 7))

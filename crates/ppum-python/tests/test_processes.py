"""Pickles, other processes, threads, signals."""

import io
import multiprocessing
import os
import pickle
import subprocess
import sys
import threading
import time

import numpy as np
import ppum
import pytest
from conftest import plate

X, Y = np.random.default_rng(1).uniform(-1, 1, (2, 20_000))


def test_datasets_and_fields_can_be_pickled(ds, f, problem, tmp_path):
    again = pickle.loads(pickle.dumps(ds))
    assert again == ds and again.to_bytes() == ds.to_bytes()
    part = f.part("jump").with_weight("cubic")
    other = pickle.loads(pickle.dumps(part))
    assert np.array_equal(other.at(X, Y).uy, part.at(X, Y).uy, equal_nan=True)
    assert pickle.loads(pickle.dumps(problem)) == problem
    assert pickle.loads(pickle.dumps(list(ds.tips)))[0] == ds.tips[0]
    ds.save(tmp_path / "a.h5")
    ds.save(str(tmp_path / "a.h5"))
    with open(tmp_path / "a.h5", "rb") as file:
        assert ppum.open(file) == ppum.open(tmp_path / "a.h5") == ppum.open(io.BytesIO(ds.to_bytes())) == ds


def work(data):
    dataset = pickle.loads(data)
    values = dataset.field.evaluate(X, Y, ["uy", "s1"])
    return values, dataset.field.draw.render("ux", size=(64, 128)), ppum.solve(plate((6, 12))).tips[0].k1


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_other_processes(method, ds):
    data = pickle.dumps(ds)
    expected = work(data)  # so the threads of this process are there
    context = multiprocessing.get_context(method)
    with context.Pool(2) as pool:
        for found in pool.map_async(work, [data] * 3).get(timeout=120):
            assert np.array_equal(found[0], expected[0], equal_nan=True)
            assert np.array_equal(found[1], expected[1], equal_nan=True)
            assert found[2] == expected[2]
    again = work(data)
    assert again[2] == expected[2]


def test_many_threads(f):
    expected, found = f.at(X, Y).von_mises, [None] * 8

    def evaluate(k):
        found[k] = f.at(X, Y).von_mises

    threads = [threading.Thread(target=evaluate, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert all(np.array_equal(values, expected, equal_nan=True) for values in found)


class Enough(Exception):
    """Ends a solution that would take minutes."""


def test_python_goes_on_meanwhile():
    """Other threads work while a solution is made, not only where Python is called to hear of its progress."""
    reports, naps = 0, 0

    def nap():
        nonlocal naps
        while naps < 200:
            time.sleep(0.001)
            naps += 1

    thread = threading.Thread(target=nap)

    def progress(*_):
        nonlocal reports
        if reports == 0:
            thread.start()
        reports += 1
        if naps == 200:
            raise Enough

    with pytest.raises(Enough):
        ppum.solve(plate((128, 256)), progress=progress)
    thread.join()
    # a nap for each report, if Python were locked in between
    assert reports < 100


def test_progress(problem):
    heard = []
    ppum.solve(problem, progress=lambda *p: heard.append(p))
    assert heard and all(0 <= done <= total and total >= 1 and step == 0 for _, done, total, step in heard)
    assert {phase for phase, *_ in heard} <= {"cover", "basis", "assembly", "solution", "estimate", "intensity"}


def test_an_exception_of_progress_ends_the_solution(problem):
    reports = []

    def stop(*report):
        reports.append(report)
        raise Enough

    start = time.process_time()
    with pytest.raises(Enough):
        ppum.solve(problem.discretization(cells=(128, 256)), progress=stop)
    # minutes of processor time, if it were not stopped
    assert len(reports) == 1 and time.process_time() - start < 30


SLOW = """
import os, signal, sys, threading, time
import numpy as np, ppum
from conftest import plate
# who started the tests in the background has signals ignored
signal.signal(signal.SIGINT, signal.default_int_handler)
what = sys.argv[1]
ds = ppum.solve(plate((6, 12)))
big = np.random.default_rng(0).uniform(-1, 1, (2, 20_000_000)) if what == "evaluate" else None

def interrupt():
    # in the middle of the work, however slow the machine is
    while time.process_time() < start + 0.5:
        time.sleep(0.01)
    interrupted_at.append(time.process_time())
    os.kill(os.getpid(), signal.SIGINT)

thread, interrupted_at = threading.Thread(target=interrupt, daemon=True), []
try:
    start = time.process_time()
    thread.start()
    if what == "solve":
        ppum.solve(plate((128, 256)))
    elif what == "evaluate":
        ds.field.evaluate(*big, ["s1", "von_mises", "s1*s2^2 + exp(sxy)"])
    else:
        ds.field.draw.figure("von_mises", size=(12000, 12000)).png()
except KeyboardInterrupt:
    print("interrupted", time.process_time() - interrupted_at[0], flush=True)
    # all goes on as before
    print(ds.field.at(0.5, 0.5).ux, ppum.solve(plate((6, 12))) .tips[0].k1 == ds.tips[0].k1, flush=True)
"""


@pytest.mark.parametrize("what", ["solve", "evaluate", "figure"])
def test_ctrl_c(what):
    folder = os.path.dirname(__file__)
    run = [sys.executable, "-c", SLOW, what]
    with subprocess.Popen(run, cwd=folder, stdout=subprocess.PIPE, text=True) as process:
        told, seconds = process.stdout.readline().split()
        # seconds of the processor, on all threads
        assert told == "interrupted" and float(seconds) < 30
        assert process.stdout.readline().endswith("True\n")
        process.wait(300)


def test_results_do_not_depend_on_threads(problem, ds):
    one = ppum.solve(problem, threads=1)
    assert [t.k1 for t in one.tips] == [t.k1 for t in ds.tips]
    assert np.array_equal(one.field.at(X, Y).uy, ds.field.at(X, Y).uy, equal_nan=True)

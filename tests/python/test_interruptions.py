"""What ends a call before its time leaves an exception, and nothing else: no process, no file."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import kerf

# Meshes for minutes, says when it has begun, and tells how it ended.
LONG_CALL = """
import os, kerf
def say(stage, done, total):
    if not said:
        print("begun", flush=True)
        said.append(stage)
said = []
surface = kerf.read(os.path.join(os.environ["KERF_ASSETS"], "cube.stl"))
size = 0.005 * surface.area ** 0.5
try:
    kerf.mesh(surface, parts=4, size=size, progress=say)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """A folder for temporary files that has to be empty in the end."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


def children_of(process):
    found = subprocess.run(["ps", "--no-headers", "-o", "pid", "--ppid", str(process)], capture_output=True, text=True)
    return found.stdout.split()


def test_control_c_ends_a_call_and_its_workers(temporary):
    call = subprocess.Popen([sys.executable, "-c", LONG_CALL], stdout=subprocess.PIPE, text=True)
    assert call.stdout.readline() == "begun\n"
    for _ in range(200):  # until there are workers
        workers = children_of(call.pid)
        if workers:
            break
        time.sleep(0.05)
    assert workers
    call.send_signal(signal.SIGINT)
    assert call.communicate(timeout=60)[0] == "interrupted\n"
    assert call.returncode == 0
    assert not any(os.path.exists(f"/proc/{worker}") for worker in workers)


# Minutes with so narrow a gap: once with a file, once with arrays.
LONG_WRAP = """
import os, sys, kerf
surface = path = os.path.join(os.environ["KERF_ASSETS"], "pipe_with_holes.stl")
if sys.argv[1] == "arrays":
    surface = kerf.read(path)
print("begun", flush=True)
try:
    kerf.wrap(surface, gap="0.6%")
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize("given", ["file", "arrays"])
def test_control_c_ends_a_wrap(temporary, given):
    call = subprocess.Popen([sys.executable, "-c", LONG_WRAP, given], stdout=subprocess.PIPE, text=True)
    assert call.stdout.readline() == "begun\n"
    time.sleep(0.2)
    call.send_signal(signal.SIGINT)
    try:
        assert call.communicate(timeout=30)[0] == "interrupted\n"
    finally:
        call.kill()
    assert call.returncode == 0


def test_progress_ends_a_call(cube, temporary):
    with pytest.raises(kerf.Cancelled):
        kerf.mesh(kerf.Surface(*cube), size=0.1, progress=lambda stage, done, total: False)


@pytest.mark.parametrize("answer", [False, np.bool_(False)])
def test_who_has_cancelled_is_told(cube, temporary, answer):
    with pytest.raises(kerf.Cancelled, match="by progress"):
        kerf.mesh(kerf.Surface(*cube), size=0.1, progress=lambda stage, done, total: answer)


@pytest.mark.parametrize("answer", [None, True, 0, 0.0, "", np.float64(0), np.int64(0)])
def test_only_false_ends_a_call(cube, temporary, answer):
    events = []

    def progress(*event):
        events.append(event)
        return answer

    mesh = kerf.mesh(kerf.Surface(*cube), size=0.3, parts=2, progress=progress)
    assert len(mesh.tetrahedra) > 0 and all(stage in kerf.mesh.__doc__ for stage, _, _ in events)
    assert all(total is None or total >= 1 for _, _, total in events)
    assert {"decompose", "volume"} <= {stage for stage, _, _ in events}


def test_what_progress_raises_ends_a_call(cube, temporary):
    def fail(stage, done, total):
        raise ZeroDivisionError(stage)

    with pytest.raises(ZeroDivisionError):
        kerf.mesh(kerf.Surface(*cube), size=0.1, progress=fail)


def test_threads_mesh_at_once(cube, temporary):
    surface = kerf.Surface(*cube)
    alone = kerf.mesh(surface, parts=3, size=0.2)
    results = [None] * 4

    def work(i):
        results[i] = kerf.mesh(surface, parts=3, size=0.2)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        assert np.array_equal(result.points, alone.points)
        assert np.array_equal(result.tetrahedra, alone.tetrahedra)


def test_python_goes_on_while_a_call_meshes(cube, temporary):
    counted = []
    ended = threading.Event()

    def count():
        while not ended.is_set():
            counted.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = len(counted)
    kerf.mesh(kerf.Surface(*cube), size=0.05)
    during = len(counted) - before
    ended.set()
    thread.join()
    assert during > 5


@pytest.mark.parametrize("signal_of_crash", ["SEGV", "KILL"])
def test_a_worker_that_crashes_is_an_exception(cube, temporary, signal_of_crash, tmp_path_factory, monkeypatch):
    programs = tmp_path_factory.mktemp("programs")
    worker = programs / "kerf-worker"
    worker.write_text(f"#!/bin/sh\nkill -{signal_of_crash} $$\n")
    worker.chmod(0o755)
    monkeypatch.setenv("KERF_PROGRAMS", str(programs))
    with pytest.raises(kerf.MeshingError) as raised:
        kerf.mesh(kerf.Surface(*cube), size=0.3, attempts=1)
    assert "Part 1" in str(raised.value)
    assert raised.value.code == 4


def test_memory_has_a_limit(cube, temporary):
    with pytest.raises(kerf.OutOfMemory):
        kerf.mesh(kerf.Surface(*cube), size=0.017, parts=1, memory="64M", attempts=1)

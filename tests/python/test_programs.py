"""Programs that the module runs: their errors, and their end."""

import os
import signal
import subprocess
import threading
import time

import pytest

import kerf
from kerf import programs


@pytest.fixture
def started(monkeypatch):
    """The processes that are started."""
    processes = []

    class Recorded(subprocess.Popen):
        def __init__(self, *arguments, **options):
            super().__init__(*arguments, **options)
            processes.append(self)

    monkeypatch.setattr(subprocess, "Popen", Recorded)
    return processes


def living(session):
    """Processes of a session."""
    alive = []
    for each in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{each}/stat") as file:
                state, _, _, of = file.read().rpartition(")")[2].split()[:4]
        except OSError:  # it has ended
            continue
        if int(of) == session and state != "Z":
            alive.append(int(each))
    return alive


CUBE = os.path.join(os.environ["KERF_ASSETS"], "cube.stl")
LONG_RUN = ["mesh", CUBE, "--surface=keep", "--size=0.01", "-n", "1", "-q"]


def wait_for_workers(processes):
    while not processes or len(living(processes[0].pid)) < 2:
        time.sleep(0.01)


def test_ctrl_c_ends_a_program_and_its_children(started, tmp_path):
    def press():
        wait_for_workers(started)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        programs.run("kerf", [*LONG_RUN, "-o", str(tmp_path / "out")])
    thread.join()
    assert living(started[0].pid) == []


def test_progress_ends_a_program_and_its_children(started, tmp_path):
    told = []

    def progress(*event):
        told.append(event)
        return len(living(started[0].pid)) < 2

    with pytest.raises(kerf.Cancelled):
        programs.run("kerf", [*LONG_RUN, "-o", str(tmp_path / "out")], progress, "mesh")
    assert set(told) == {("mesh", 0, 0)} and living(started[0].pid) == []
    with pytest.raises(kerf.Cancelled, match="longer than 0.1 s"):
        programs.run("kerf", [*LONG_RUN, "-o", str(tmp_path / "out")], timeout=0.1)
    assert living(started[1].pid) == []


def test_exit_codes_are_exceptions(monkeypatch):
    assert programs.run("kerf", ["--version"]).startswith("kerf")
    with pytest.raises(kerf.UsageError, match="--foo"):
        programs.run("kerf", ["mesh", "--foo"])
    with pytest.raises(kerf.FileError, match="^nowhere.stl: the file cannot be read"):
        programs.run("kerf", ["check", "nowhere.stl"])
    with pytest.raises(kerf.FileError, match="kerf-nothing .* KERF_PROGRAMS"):
        programs.run("kerf-nothing", [])


def test_options_are_flags():
    assert programs.flags({"max_volume": 0.5, "unite": True, "size_on": ["a=1", "b=2"], "cells": None}) == [
        "--max-volume=0.5", "--unite=true", "--size-on=a=1", "--size-on=b=2"]

"""Calls of other programs whose seconds and memory count."""

import dataclasses
import json
import os
import pathlib
import re
import signal
import subprocess
import threading
import time


@dataclasses.dataclass
class Measured:
    seconds: float  # of wall clock
    processor_seconds: float  # of the program and all that it has started, with the system's
    peak_bytes: int  # of the largest process
    log: str
    exit_code: int


def run_measured(command, log, limit):
    """Runs a command, what it says in the file `log`. Raises TimeoutExpired."""
    start = time.perf_counter()
    with open(log, "w") as out:
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT)
        watch = threading.Timer(limit, process.kill)
        watch.start()
        _, status, usage = os.wait4(process.pid, 0)
        watch.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode == -signal.SIGKILL:
        raise subprocess.TimeoutExpired(command, limit)
    seconds = time.perf_counter() - start
    return Measured(seconds, usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss, pathlib.Path(log).read_text(),
                    process.returncode)


def run_gmsh(script, log, limit):
    """Has gmsh run a script. What it did, and the seconds of the processor that its log has for cells: to make them,
    and to make them better afterwards (0 where that is part of the first). Raises RuntimeError with what it says of its
    end, or else with its exit code, that of a signal negative."""
    done = run_measured(["gmsh", "-nopopup", "-parse_and_exit", script], log, limit)
    error = re.search(r"^Error *: (.*)", done.log, re.MULTILINE)
    seconds = [re.search(rf"Done {step} \(Wall [\d.e+-]+s, CPU ([\d.e+-]+)s\)", done.log)
               for step in ("meshing 3D", "optimizing mesh")]
    if error or not seconds[0]:
        raise RuntimeError(error[1] if error else f"gmsh has failed ({done.exit_code})")
    made, improved = (float(found[1]) if found else 0.0 for found in seconds)
    return done, made, improved


def output_of(*command, limit=None):
    """The JSON that a helper says."""
    return json.loads(subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True,
                                     text=True, timeout=limit, check=True).stdout)


def rate_of(count, seconds):
    """By second. None where it is unknown: the log of gmsh says 0 seconds of what took less than its clock can tell."""
    return count / seconds if seconds else None


def rate_text(rate):
    return "-" if rate is None else f"{rate:,.0f}"


def ratio_text(rate, by, digits=2):
    """Of two rates; a dash where one is unknown or 0."""
    return f"{rate / by:.{digits}f}" if rate and by else "-"


def failure_of(error, limit):
    """What a table says of a call that has raised this."""
    if isinstance(error, subprocess.TimeoutExpired):
        return f"more than {limit:g} s"
    return str(getattr(error, "stderr", None) or error).strip()

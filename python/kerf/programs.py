"""Where the programs beside the module are, and how they are run: kerf-worker, which meshes parts, and those that read
CAD, solve and draw."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path
from typing import Callable, Iterable, Mapping, Optional

from . import _kerf
from .errors import Cancelled, error_of

_SECONDS_BETWEEN_LOOKS = 0.1
_SECONDS_FOR_AN_END = 0.3


def folder() -> str:
    """Their folder; empty: where the kernel looks for them by itself.

    Those that the environment variable KERF_PROGRAMS names come first, then those of a wheel, of a build, and of an
    installed tree.
    """
    if os.environ.get("KERF_PROGRAMS"):
        return ""
    package = Path(__file__).resolve().parent
    for place in ("bin", "../..", "../../../../bin", "../../../../libexec/kerf"):
        candidate = (package / place).resolve()
        if (candidate / "kerf-worker").is_file():
            return str(candidate)
    return ""


def path(name: str) -> str:
    """Of one of them. Raises FileError, naming the places where it was looked for, if there is none."""
    return _kerf.find_program(name, folder())


def flags(options: Mapping[str, object]) -> list[str]:
    """Keyword arguments as a command line has them: max_volume=0.1 as --max-volume=0.1, a list as the option several
    times, None as no option."""
    result = []
    for name, value in options.items():
        each_of = value if isinstance(value, (list, tuple)) else [] if value is None else [value]
        for each in each_of:
            text = str(each).lower() if isinstance(each, bool) else os.fspath(each) if _is_path(each) else str(each)
            result.append(f"--{name.replace('_', '-')}={text}")
    return result


def run(name: str, arguments: Iterable[str], progress: Optional[Callable[[str, int, int], Optional[bool]]] = None,
        stage: str = "", timeout: Optional[float] = None) -> str:
    """Runs one of them to its end, and returns what it has printed.

    progress   called with (stage, 0, 0) ten times a second: returning False ends the program with Cancelled
    timeout    seconds after which it is ended with Cancelled

    It is a process of its own, out of reach of the terminal's Ctrl-C: that, and whatever `progress` raises, ends it and
    its children within a second. Raises the exception of its exit code with what it has said, and FileError where the
    program is missing.
    """
    process = subprocess.Popen([path(name), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True)
    try:
        output, said = _communicate(process, name, progress, stage, timeout)
    except BaseException:
        _end(process)
        raise
    if process.returncode != 0:
        raise error_of(process.returncode, _sentence(said) or _end_of(name, process.returncode), [])
    return output


def _communicate(process: subprocess.Popen, name: str, progress: Optional[Callable[[str, int, int], Optional[bool]]],
                 stage: str, timeout: Optional[float]) -> tuple[str, str]:
    start = time.monotonic()
    while True:
        try:
            return process.communicate(timeout=_SECONDS_BETWEEN_LOOKS)
        except subprocess.TimeoutExpired:
            if progress is not None and progress(stage, 0, 0) is False:
                raise Cancelled(f"{name} was cancelled by progress, which returned False.") from None
            if timeout is not None and time.monotonic() - start > timeout:
                raise Cancelled(f"{name} took longer than {timeout:g} s and was ended.") from None


def _end(process: subprocess.Popen) -> None:
    """As a user at a terminal would: by Ctrl-C, which lets it end its own children, then with more force."""
    for signal_ in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        if process.poll() is None:
            (os.killpg if signal_ == signal.SIGKILL else os.kill)(process.pid, signal_)
            try:
                process.wait(_SECONDS_FOR_AN_END)
            except subprocess.TimeoutExpired:
                pass
    for pipe in (process.stdout, process.stderr):
        if pipe is not None:
            pipe.close()


def _sentence(said: str) -> str:
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    return " ".join(line[len("kerf: "):] if line.startswith("kerf: ") else line for line in lines)


def _end_of(name: str, code: int) -> str:
    return f"{name} was killed by signal {-code}." if code < 0 else f"{name} has ended with exit code {code}."


def _is_path(value: object) -> bool:
    return hasattr(value, "__fspath__")

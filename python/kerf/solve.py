"""Displacements and stresses of elastic bodies."""

from __future__ import annotations

import os
from tempfile import TemporaryDirectory
from typing import Mapping, Optional, Union

from . import programs
from .case_file import case_text
from .errors import Error, UsageError
from .paths import Path
from .progress import Progress, caller
from .solution import Solution


def solve(run: Union[Path, object], case: Union[Mapping[str, object], Path], output: Optional[Path] = None,
          progress: Progress = None, **options: object) -> Solution:
    """Displacements and stresses of a body under loads, on the parts of a finished run.

    run        a Run, or its folder; or the file of a surface, which is meshed first: into OUTPUT/mesh
    case       materials, supports and loads: a dict with the keys of the file (docs/solvers.md), or the path of one
    output     folder for the solution, which replaces an older one there; None: one that goes with the Solution
    progress   True: a line on standard error; or called with ("solve", 0, None): returning False ends the work
    options    those of `kerf solve`, with underscores: ranks, target_error; of a surface those of `kerf mesh`, too

        case = {"material": {"steel": {"young": 210e3, "poisson": 0.3}},
                "support": [{"patch": "face_1", "fixed": True}],
                "load": [{"patch": "face_2", "pressure": 10}]}
        solution = kerf.solve("out", case)
        solution.points, solution.displacement, solution.von_mises, solution.reactions

    The program kerf-solve does it, which is built where PETSc is, in processes of its own: as many as are of use, or
    `ranks`. Raises UsageError for a case that does not fit, FileError where the program or a file is missing,
    ConvergenceError, OutOfMemory, Cancelled; KeyboardInterrupt ends its processes.
    """
    folder = getattr(run, "folder", run)
    if not isinstance(folder, (str, os.PathLike)):
        raise UsageError(f"run is a {type(run).__name__}, but a Run, its folder or the file of a surface is wanted: "
                         "kerf.mesh(..., output=FOLDER) makes one.")
    owner = None
    if output is None:
        owner = TemporaryDirectory(prefix="kerf-solution-")
        output = os.path.join(owner.name, "solution")
    place = os.fspath(output)
    with TemporaryDirectory(prefix="kerf-case-") as beside:
        if isinstance(case, Mapping):
            file = os.path.join(beside, "case.toml")
            with open(file, "w", encoding="utf-8") as written:
                written.write(case_text(case))
        else:
            file = os.fspath(case)
        arguments = ["solve", os.fspath(folder), f"--case={file}", f"--output={place}", "--quiet=true",
                     *programs.flags(options)]
        try:
            programs.run("kerf-solve", arguments, caller(progress), "solve")
        except Error as error:
            message = str(error).replace(os.path.join(beside, "case.toml"), "the case")
            raise type(error)(message, error.elements) from None
    return Solution(place, owner)

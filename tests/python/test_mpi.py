"""kerf.mesh() and kerf.distributed() on the ranks of MPI, by scripts that are run under mpirun."""

import filecmp
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("mpi4py")
pytest.importorskip("kerf._mpi", reason="Kerf was built without MPI")
HERE = Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "examples"
sys.path[:0] = [str(HERE / "ranks"), str(EXAMPLES)]

import kerf  # noqa: E402
import two_boxes  # noqa: E402
from compared import OPTIONS  # noqa: E402


def run_on_ranks(count, script, *arguments, folder):
    """A rank that fails ends the others."""
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "TMPDIR": str(folder), "OMP_NUM_THREADS": "1", "XDG_CACHE_HOME": str(folder / "cache"),
                   "PYTHONPATH": os.pathsep.join([os.environ.get("PYTHONPATH", ""), str(EXAMPLES)])}
    command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(count), sys.executable, "-B", "-m",
               "mpi4py", str(script), *map(str, arguments)]
    result = subprocess.run(command, env=environment, cwd=folder, timeout=120, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    assert result.returncode == 0, result.stdout
    return result.stdout


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The mesh without ranks: file of its arrays and run folder."""
    folder = tmp_path_factory.mktemp("whole")
    surface = two_boxes.surface()
    mesh = kerf.mesh(surface, **OPTIONS)
    names = ("points", "tetrahedra", "part", "region", "triangles", "patch", "sides")
    np.savez(folder / "whole.npz", **{name: getattr(mesh, name) for name in names})
    kerf.mesh(surface, output=folder / "run", **OPTIONS)
    return folder


def test_shares_are_those_of_the_mesh_without_ranks(whole, tmp_path):
    (tmp_path / "runs").mkdir()
    run_on_ranks(3, HERE / "ranks/laws.py", whole / "whole.npz", tmp_path / "runs", folder=tmp_path)
    theirs = whole / "run/parts"
    names = sorted(os.listdir(theirs))
    assert len(names) == 2 * OPTIONS["parts"]
    for ranks in ("all", "2", "1"):
        ours = tmp_path / "runs" / ranks / "parts"
        assert sorted(os.listdir(ours)) == names
        assert filecmp.cmpfiles(ours, theirs, names, shallow=False)[0] == names, f"bytes of {ranks} ranks"


def test_errors_of_one_rank_are_those_of_all(tmp_path):
    run_on_ranks(2, HERE / "ranks/errors.py", folder=tmp_path)


@pytest.mark.parametrize("library, module", [("petsc", "petsc4py"), ("dolfinx", "dolfinx")])
def test_examples_solve_without_gathering(library, module, tmp_path):
    if importlib.util.find_spec(module) is None:
        pytest.skip(f"{module} is missing")
    run_on_ranks(2, HERE / f"ranks/check_{library}.py", folder=tmp_path)

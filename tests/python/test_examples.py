"""The examples are run as they are; those on ranks by test_mpi.py."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import kerf

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(name, *arguments, folder):
    done = subprocess.run([sys.executable, "-B", str(EXAMPLES / name), *map(str, arguments)], cwd=folder, timeout=120,
                          capture_output=True, text=True, env=dict(os.environ, TMPDIR=str(folder)))
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_first_mesh(tmp_path):
    assert "part 4: " in run("first_mesh.py", folder=tmp_path)


def test_sizes_by_function(tmp_path):
    told = run("sizes_by_function.py", folder=tmp_path).splitlines()[-1]
    near, elsewhere = re.findall(r"[0-9.]+", told)
    assert 2 * float(near) < float(elsewhere)


def test_quality_plot(tmp_path):
    pytest.importorskip("matplotlib")
    assert "degrees" in run("quality_plot.py", tmp_path / "quality.png", folder=tmp_path)
    assert (tmp_path / "quality.png").read_bytes().startswith(b"\x89PNG")


def test_study(tmp_path):
    cells = [int(line.split()[1]) for line in run("study.py", folder=tmp_path).splitlines()[1:]]
    assert cells == sorted(cells) and cells[-1] > 3 * cells[0]


def test_two_regions_to_stresses(tmp_path):
    try:
        kerf.programs.path("kerf-solve")
    except kerf.FileError:
        if os.environ.get("CI") == "true":
            raise
        pytest.skip("kerf-solve is not built")
    assert "reaction of" in run("bone_and_cement.py", tmp_path / "result", folder=tmp_path)

"""Notes: what the command line prints of changes and shortcomings is there in Python, too."""

import copy
import pickle
import re
import subprocess
import os

import numpy as np
import pytest

import kerf

ASSETS = os.environ["KERF_ASSETS"]
CAP = f"{ASSETS}/bearing_cap_14k.stl"


def printed(*arguments):
    """What the program prints, with spaces as they are in notes."""
    run = subprocess.run([os.environ["KERF_PROGRAM"], *arguments], capture_output=True, text=True, check=True)
    return re.sub(r"^(\w+) +", r"\1: ", run.stderr + run.stdout, flags=re.M)


def test_mesh_has_the_sentences_of_the_command_line(tmp_path):
    mesh = kerf.mesh(CAP, size="5%", parts=2)
    of_sizes = [note for note in mesh.notes if note.startswith("sizes: ")]
    assert len(of_sizes) == 1 and "of the wanted length on average" in of_sizes[0]
    assert 'surface="remesh"' in of_sizes[0]  # in the words of Python
    assert of_sizes[0].replace('surface="remesh"', "--surface remesh") in printed(
        "mesh", CAP, "--size", "5%", "-n", "2", "-o", str(tmp_path / "out"))


def test_notes_are_of_runs_and_copies_too(tmp_path):
    mesh = kerf.mesh(CAP, size="5%", parts=2)
    run = kerf.mesh(CAP, size="5%", parts=2, output=tmp_path / "run")
    assert run.notes == mesh.notes and run.mesh().notes == mesh.notes
    assert pickle.loads(pickle.dumps(mesh)).notes == copy.deepcopy(mesh).notes == mesh.notes
    assert ", 1 note>" in repr(mesh) and ", 1 note>" in repr(run)
    assert "<td>notes</td>" in mesh._repr_html_().replace(" style='text-align:right'", "")


def test_nothing_to_say(cube, recwarn):
    mesh = kerf.mesh(kerf.Surface(*cube))
    assert mesh.notes == [] and "note" not in repr(mesh)
    assert kerf.Surface(*cube).notes == []
    assert len(recwarn) == 0


def test_sharp_cells_are_told(cube):
    points, triangles = cube
    mesh = kerf.mesh(kerf.Surface(points * [1, 1, 0.01], triangles), surface="keep")
    assert any(note.startswith("sharp: ") for note in mesh.notes), mesh.notes


def test_remeshed_surface_says_how_far_it_is(cube):
    remeshed = kerf.read(CAP).remesh(size="4%", deviation="0.5%")
    note = next(note for note in remeshed.notes if note.startswith("remeshed: "))
    assert "from 14,072 facets" in note and "largest distances" in note and "--" not in note
    assert ", 1 note>" in repr(remeshed)
    assert pickle.loads(pickle.dumps(remeshed)).notes == remeshed.notes
    mesh = kerf.mesh(remeshed)
    assert note in mesh.notes  # it is of the mesh, too


@pytest.mark.parametrize("make", [kerf.repair, kerf.Surface])
def test_repairs_and_holes_are_told(cube, make):
    points, triangles = cube
    options = {"steps": "full"} if make is kerf.repair else {"fill_holes": 3}
    mended = make(points, triangles[1:], **options)
    assert any("filled" in note for note in mended.notes), mended.notes


def test_wrap_says_its_distance(cube):
    points, triangles = cube
    around = kerf.wrap(points, triangles[1:], gap=0.8)
    assert any(note.startswith("wrapped: ") for note in around.notes), around.notes

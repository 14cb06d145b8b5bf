"""kerf.plot(): pictures without a display."""

import os
import struct
import tempfile
import zlib

import numpy as np
import pytest

import kerf
from kerf import programs

try:
    programs.path("kerf-view")
except kerf.FileError:
    pytest.skip("kerf-view is not built", allow_module_level=True)

SIZE = (200, 150)


def pixels(picture):
    """(height, width, channels) of a PNG with one byte a channel, whose filters are left as they are."""
    assert picture.startswith(b"\x89PNG\r\n\x1a\n")
    width, height, depth, kind = struct.unpack(">IIBB", picture[16:26])
    assert depth == 8
    data, place = b"", 8
    while place < len(picture):
        length, name = struct.unpack(">I4s", picture[place:place + 8])
        data += picture[place + 8:place + 8 + length] if name == b"IDAT" else b""
        place += length + 12
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, -1)[:, 1:]
    return rows.reshape(height, width, {2: 3, 6: 4}[kind])


def assert_shows_something(picture, size=SIZE):
    shown = pixels(picture)
    assert shown.shape[:2] == size[::-1]
    assert len(np.unique(shown.reshape(-1, shown.shape[2]), axis=0)) > 50


@pytest.fixture(scope="module")
def mesh():
    return kerf.mesh(kerf.Surface(*CUBE), parts=3, size=0.3)


CUBE = (np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float),
        np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6],
                  [0, 6, 2], [1, 3, 7], [1, 7, 5]]))


def test_pictures_of_what_is_in_memory(mesh, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    cut = kerf.plot(mesh, clip="x=0.5", color="min-dihedral", size=SIZE)
    assert_shows_something(cut)
    far = kerf.mesh(kerf.Surface(4 * CUBE[0] - 1, CUBE[1]), parts=3, size=1.2)
    assert kerf.plot(far, clip=([0, 0, 0], [1, 0, 0]), size=SIZE) == kerf.plot(far, clip="x=0.25", size=SIZE)
    assert kerf.plot(mesh, color="part", explode=0.5, size=SIZE) != cut
    assert_shows_something(kerf.plot(kerf.Surface(*CUBE), size=SIZE))
    assert_shows_something(kerf.plot(kerf.decompose(kerf.Surface(*CUBE), parts=2, size=0.3).parts[0], size=SIZE))
    assert os.listdir(tmp_path) == []


def test_pictures_of_files(tmp_path):
    file = tmp_path / "picture.png"
    picture = kerf.plot(os.path.join(os.environ["KERF_ASSETS"], "bone.stl"), file, view="front", size=(300, 100))
    assert_shows_something(picture, (300, 100))
    assert file.read_bytes() == picture == picture._repr_png_()


def test_notebooks_show_counts_and_a_picture(mesh, monkeypatch):
    page = mesh._repr_html_()
    assert f"{len(mesh.tetrahedra):,}" in page and "data:image/png;base64," in page
    assert "<td>volume</td><td style='text-align:right'>1</td>" in kerf.Surface(*CUBE)._repr_html_()
    monkeypatch.setattr("kerf.notebook.MOST_ELEMENTS_OF_PICTURE", 1)
    assert "data:image" not in mesh._repr_html_()


def test_what_is_wrong_is_said(mesh):
    with pytest.raises(kerf.UsageError, match="'blue' is no colouring"):
        kerf.plot(mesh, color="blue")
    with pytest.raises(kerf.FileError, match="nowhere.stl"):
        kerf.plot("nowhere.stl")
    with pytest.raises(TypeError, match="parts of trees and files, but no Tree"):
        kerf.plot(kerf.decompose(kerf.Surface(*CUBE), parts=2))
    with pytest.raises(kerf.UsageError, match="share of the bounding box"):
        kerf.plot("nowhere.stl", clip=([0, 0, 0], [1, 0, 0]))
    with pytest.raises(kerf.Cancelled):
        kerf.plot(mesh, timeout=0.001)

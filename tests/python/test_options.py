"""The options of the command line as keyword arguments."""

import decimal
import fractions
import os
import pathlib
import re
import subprocess

import numpy as np
import pytest
from conftest import CUBE_POINTS, CUBE_TRIANGLES

import kerf
from kerf.option_table import in_python
from kerf.options import NOT_IN_MEMORY, split, texts


@pytest.fixture(scope="module", autouse=True)
def small_folder(tmp_path_factory):
    """Files of the tests are named cube.obj, in this folder, with a patch named cube."""
    before = os.getcwd()
    os.chdir(tmp_path_factory.mktemp("options"))
    kerf.Surface(CUBE_POINTS, CUBE_TRIANGLES, names=["cube"]).save(CUBE)
    yield
    os.chdir(before)


CUBE = "cube.obj"

#: Flags of `kerf mesh` that are no options of a mesh, and why.
OF_THE_PROGRAM = {
    "--output": "an argument of kerf.mesh() of its own",
    "--config": "a dict can be given as keyword arguments",
    "--print-config": "kerf.options() has the table",
    "--resume": "continues a run of the program",
    "--dry-run": "prints a forecast, and makes no mesh",
    "--quiet": "nothing is printed",
    "--verbose": "nothing is printed",
    "--help": "help(kerf.mesh)",
}


def flags_of_help():
    text = subprocess.run([os.environ["KERF_PROGRAM"], "mesh", "--help"], capture_output=True, text=True,
                          check=True).stdout
    return set(re.findall(r"^ +(?:-\w, ?)?(--[a-z-]+)", text, re.M))


def test_the_table_is_that_of_the_command_line():
    table = {option.flag for option in kerf.options()}
    of_help = flags_of_help()
    assert len(of_help) > 40
    assert of_help - set(OF_THE_PROGRAM) == table
    config = subprocess.run([os.environ["KERF_PROGRAM"], "mesh", "--print-config"], capture_output=True, text=True,
                            check=True).stdout
    values = dict(re.findall(r"^([a-z-]+) = (.*)$", config, re.M))
    for option in kerf.options():
        if option.default not in ("", "0") and option.name != "workers":
            assert values[option.flag[2:]].strip('"') in (option.default, option.default + ".0")


#: Calls that together have every option of a mesh in memory.
CALLS = [
    dict(parts=2, size=0.5, size_is="bound", max_volume=0, cells=None, fineness="medium",
         size_in={"sphere:0,0,0,0.3": 0.3}, size_on={"cube": "40%"}, size_near={"cube": (0.4, 0.1)}, size_region={},
         growth=1, chord_error="1%", segments_per_turn=3, cells_across=0.5, radius_edge=2, cut="inertia", balance="work", contour="edges",
         surface="split", deviation=0.01, mesher="lattice", improve=True, workers=1, timeout=100, attempts=3,
         tetgen_switches=None),
    dict(order=2, curve="straight", cells=1e2, axis="x", surface="keep", memory="1G", improve=False, feature_angle=30, optimise_surface=1),
    dict(cells="200", tetgen_switches="q1.5", fineness="coarse", scale=2, weld="0.001%", fill_holes=3,
         keep_largest=True, voids="parity", fill_voids=False, solid=0, unite=False, no_imprint=None,
         cad_deflection=0, with_=[], repair="near,no-holes", cap=False, thicken=0,
         gap=0, offset=0),
    dict(region={"steel": (0.5, 0.5, np.float32(0.5))}),
    dict(gap="12%", offset="2%"),
    dict(box="0.5,0.5,1", box_size=0.6, wind="-x", ground="0.2", wake=0.5, hole=[]),
]


@pytest.mark.parametrize("call", CALLS)
def test_mesh_takes_every_option(call):
    mesh = kerf.mesh(CUBE, **call)
    assert len(mesh.tetrahedra) >= 5


def test_files_are_options_too(tmp_path):
    kerf.mesh(CUBE, parts=2, trace=tmp_path / "trace", report=str(tmp_path / "report.json"))
    assert len(list(tmp_path.iterdir())) == 2
    with pytest.raises(kerf.FileError, match="sizes.msh"):
        kerf.mesh(CUBE, size_field=tmp_path / "sizes.msh")
    with pytest.raises(kerf.UsageError, match="^cube.obj names no unit, so that unit has no meaning"):
        kerf.mesh(CUBE, unit="mm")
    given = {name for call in CALLS for name in call} | {"trace", "report", "size_field", "unit"}
    assert {option.name for option in kerf.options()} - set(NOT_IN_MEMORY) <= given


@pytest.mark.parametrize("name", NOT_IN_MEMORY)
def test_options_of_files_are_refused_in_memory(name):
    with pytest.raises(kerf.UsageError, match=f"{name} .* leave it out"):
        kerf.mesh(CUBE, **{name: True})


@pytest.mark.parametrize("wrong, meant", [
    ("radius_edg", "radius_edge"), ("max_volum", "max_volume"), ("sizze", "size"), ("fill_hole", "fill_holes"),
    ("voidz", "voids"), ("quuxly", None)])
def test_a_wrong_keyword_is_told_what_it_may_have_been(wrong, meant, cube):
    surface = kerf.Surface(*cube)
    for call in (lambda: kerf.mesh(surface, **{wrong: 1}), lambda: kerf.mesh(CUBE, **{wrong: 1}),
                 lambda: kerf.Surface(*cube, **{wrong: 1}), lambda: kerf.check(CUBE, **{wrong: 1}),
                 lambda: kerf.read(CUBE, **{wrong: 1}), lambda: surface.remesh(**{wrong: 1}),
                 lambda: kerf.tetrahedralize(*cube, **{wrong: 1})):
        with pytest.raises(kerf.UsageError) as caught:
            call()
        text = str(caught.value)
        assert text.startswith(f"{wrong} is no option.") and "--" not in text and "version" not in text
        assert meant is None or f"Did you mean {meant}?" in text


def test_options_have_their_place(cube):
    surface = kerf.Surface(*cube)
    assert split({"fill_holes": 3, "size": 1, "with_": [], "surface": "keep"}) == \
        ({"fill_holes": 3, "with_": []}, {"size": 1, "surface": "keep"})
    assert kerf.mesh(CUBE, scale=2, size=1).points.max() == 2
    assert kerf.tetrahedralize(*cube, scale=2, size=1).nodes.max() == 2
    with pytest.raises(kerf.UsageError, match="fill_holes is an option of the surface"):
        kerf.mesh(surface, fill_holes=3)
    with pytest.raises(kerf.UsageError, match="^radius_edge is no option of a surface"):
        kerf.Surface(*cube, radius_edge=1)
    with pytest.raises(kerf.UsageError, match="^radius_edge is no option of remeshing"):
        surface.remesh(radius_edge=1)


VALUES = [
    ("improve", True, "true"), ("improve", False, "false"), ("improve", np.bool_(True), "true"), ("size", 0.1, "0.1"),
    ("size", "2%", "2%"), ("size", np.float32(0.5), "0.5"), ("size", np.array(0.25), "0.25"), ("size", 1e-7, "1e-07"),
    ("size", decimal.Decimal("0.1"), "0.1"), ("size", fractions.Fraction(1, 4), "0.25"), ("cells", 1e6, "1000000"),
    ("cells", "50k", "50k"), ("fill_holes", np.int64(7), "7"), ("fill_holes", 7.0, "7"), ("memory", "2G", "2G"),
    ("size_field", pathlib.Path("a b.msh"), "a b.msh"), ("with_", pathlib.Path("b.stl"), "b.stl"),
    ("with_", ["a.stl", pathlib.Path("b;c.stl")], "a.stl;b\\;c.stl"), ("with", "a.stl", "a.stl"),
    ("size_region", {"bone": 0.1, "cement": "3%"}, "bone=0.1;cement=3%"), ("size_on", "top=0.1", "top=0.1"),
    ("size_near", {"top": (0.1, 2)}, "top=0.1:2"), ("region", {"a": (0, 1.5, -2)}, "a=0,1.5,-2"),
    ("region", {"a": np.zeros(3)}, "a=0,0,0"), ("size_in", ["box:0,0,0,1,1,1=2", "sphere:0,0,0,1=3"],
                                                "box:0,0,0,1,1,1=2;sphere:0,0,0,1=3"),
    ("format", ["vtu", "su2"], "vtu,su2"), ("fields", "all", "all"), ("size_region", {}, ""),
    ("report", "caf\u00e9\udce9", "caf\u00e9\udce9"),
]


@pytest.mark.parametrize("name, value, text", VALUES)
def test_values_become_texts(name, value, text):
    assert texts({name: value}) == [(name.rstrip("_").replace("_", "-"), os.fsencode(text))]


def test_none_is_not_given():
    assert texts({"size": None, "improve": None, "with_": None}) == []


@pytest.mark.parametrize("options, kind, words", [
    ({"size": "big"}, kerf.UsageError, "size is 'big', but it must be a positive length"),
    ({"size": -1}, kerf.UsageError, "size is -1"),
    ({"size": float("nan")}, kerf.UsageError, "size is 'nan'"),
    ({"size": True}, kerf.UsageError, "size is 'true'"),
    ({"size": [1, 2]}, TypeError, "size takes one value, but [1, 2] has several"),
    ({"size": {"a": 1}}, TypeError, "size takes no dict"),
    ({"size": object()}, TypeError, "but it must be a length"),
    ({"size": 1j}, TypeError, "size is 1j"),
    ({"size": b"1"}, TypeError, "size is b'1'"),
    ({"size": "1\0"}, ValueError, "size has a character NUL"),
    ({"parts": 2.5}, kerf.UsageError, "parts is 2.5, but it must be a whole number"),
    ({"parts": -1}, kerf.UsageError, "parts is -1"),
    ({"workers": "many"}, kerf.UsageError, "workers is 'many'"),
    ({"improve": 2}, kerf.UsageError, "improve is '2', but it must be true or false"),
    ({"cut": "by chance"}, kerf.UsageError, "cut is 'by chance', but it must be one of inertia, volume"),
    ({"voids": "none"}, kerf.UsageError, "voids is 'none'"),
    ({"weld": "200%"}, kerf.UsageError, "weld is"),
    ({"region": {"a": (1, 2)}}, kerf.UsageError, "'a=1,2' is no value of region"),
    ({"size_on": {"nowhere": 1}}, kerf.UsageError, "nowhere"),
    ({"contour": "straight", "surface": "keep"}, kerf.UsageError,
     'contour="straight" splits facets, and surface="keep" forbids it'),
])
def test_wrong_values_are_named_as_they_are_written(options, kind, words):
    with pytest.raises(kind) as caught:
        kerf.mesh(CUBE, **options)
    assert words in str(caught.value) and "--" not in str(caught.value)


def test_texts_of_the_command_line_in_the_names_of_python():
    assert in_python("make it a void with --voids parity, turn it") == 'make it a void with voids="parity", turn it'
    assert in_python("small holes with --fill-holes, or drop") == "small holes with fill_holes, or drop"
    assert in_python("with --optimise-surface 3 the facets") == "with optimise_surface=3 the facets"
    assert in_python("--weld is 5, but") == "weld is 5, but"
    assert in_python("--needle-angle is 90") == "needle_angle is 90"
    assert in_python("Use --with FILE, or --resume.") == "Use with_ FILE, or --resume."


def test_options_are_described():
    table = {option.name: option for option in kerf.options()}
    assert table["size"].kind == "length" and table["size"].group == "Sizes" and not table["size"].is_of_surface
    assert table["voids"].choices == ("as-given", "parity") and table["voids"].is_of_surface
    assert table["radius_edge"].default == "1.4" and table["improve"].default == "true"
    assert all(option.help.endswith(".") for option in table.values())

"""kerf.solve(): the case as a dict, the solution as arrays."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import kerf
from kerf import programs

try:
    programs.path("kerf-solve")
except kerf.FileError:
    pytest.skip("kerf-solve is not built", allow_module_level=True)

YOUNG, POISSON, PULL = 200.0, 0.25, 3.0


def pulled_cube():
    """Free to become thinner: stresses are the same everywhere."""
    return {"material": {"rubber": {"young": YOUNG, "poisson": POISSON}},
            "support": [{"name": f"at {axis}", "plane": [*np.eye(3)[i], 0.0], axis: 0} for i, axis in enumerate("xyz")],
            "load": [{"name": "pull", "plane": [1, 0, 0, 1], "traction": np.array([PULL, 0, 0])}]}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("solve") / "run"
    cube = os.path.join(os.environ["KERF_ASSETS"], "cube.stl")
    subprocess.run([os.environ["KERF_PROGRAM"], "mesh", cube, "-o", folder, "-n", "2", "--size=0.4", "-q"], check=True)
    return folder


@pytest.fixture(scope="module")
def solution(run):
    return kerf.solve(run, pulled_cube(), ranks=1)


def test_the_solution_is_the_known_one(solution):
    points, strain = solution.points, PULL / YOUNG
    assert np.allclose(solution.displacement, points * [strain, -POISSON * strain, -POISSON * strain], atol=1e-8)
    assert np.allclose(solution.stress, [PULL, 0, 0, 0, 0, 0], atol=1e-4)
    assert np.allclose(solution.von_mises, PULL, rtol=1e-5)
    case = solution.cases[0]
    assert case.cell_stress.shape == (len(solution.tetrahedra), 6)
    assert case.cell_von_mises.shape == case.error_indicator.shape == (len(solution.tetrahedra),)
    assert np.isclose(solution.energy, PULL * strain / 2)
    assert np.allclose(solution.reactions["at x"], [-PULL, 0, 0], atol=1e-6)
    assert np.allclose(case.load, [PULL, 0, 0]) and case.imbalance < 1e-6
    assert np.isclose(case.max_von_mises.value, PULL, rtol=1e-5)
    assert not solution.displacement.flags.writeable


def test_parts_have_what_the_whole_has(solution):
    assert solution.part_numbers == [2, 3]
    cells = 0
    for number in solution.part_numbers:
        part = solution.part(number)
        assert np.array_equal(part.points, solution.points[part.global_ids])
        assert np.array_equal(part.displacement, solution.displacement[part.global_ids])
        whole = solution.tetrahedra[cells:cells + len(part.tetrahedra)]
        assert np.array_equal(whole, part.global_ids[part.tetrahedra])
        cells += len(whole)
    assert cells == len(solution.tetrahedra)


def test_a_solution_is_opened_again(run, tmp_path, solution):
    case = tmp_path / "case.toml"
    case.write_text("""material.rubber = {young = 200, poisson = 0.25}
        support = [{plane = [1, 0, 0, 0], x = 0}, {plane = [0, 1, 0, 0], y = 0}, {plane = [0, 0, 1, 0], z = 0}]
        load = [{plane = [1, 0, 0, 1], traction = [3, 0, 0], case = "one"},
                {plane = [1, 0, 0, 1], traction = [6, 0, 0], case = "two"}]""")
    kerf.solve(run, case, tmp_path / "out", ranks=1)
    again = kerf.Solution(tmp_path / "out")
    assert [each.name for each in again.cases] == ["one", "two"]
    assert np.allclose(again.case("one").displacement, solution.displacement, atol=1e-8)
    assert np.allclose(again.case("two").part(3).displacement, 2 * again.part(3).displacement, atol=1e-7)
    with pytest.raises(KeyError, match="'one', 'two'"):
        again.case("three")


def test_cases_may_have_all_that_files_have(run):
    case = pulled_cube()
    case["units"] = "mm"
    case["material"] = {"frame": {"like": "steel", "yield": 60}}
    case["load"][0]["case"] = "pull"
    case["temperature"] = [{"difference": 10, "case": "warm"}]
    case["combination"] = [{"name": "both", "cases": {"pull": 2, "warm": 1}}]
    solution = kerf.solve(run, case, ranks=1)
    pull, warm, both = solution.cases
    assert np.isclose(pull.safety_factor.value, 60 / PULL) and np.isclose(both.safety_factor.value, 30 / PULL)
    assert np.allclose(warm.displacement, 120e-6 * solution.points, atol=1e-9)
    assert np.allclose(both.displacement, 2 * pull.displacement + warm.displacement, atol=1e-9)
    assert set(pull.moments) == {"at x", "at y", "at z"} and np.allclose(pull.moments["at x"], 0, atol=1e-6)
    assert pathlib.Path(solution.folder, "results.csv").read_text(encoding="utf-8").count("\n") == 4


def test_a_temporary_solution_goes(run, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    solution = kerf.solve(run, pulled_cube(), ranks=1)
    assert os.path.isdir(solution.folder) and len(os.listdir(tmp_path)) == 1
    del solution
    assert os.listdir(tmp_path) == []


def test_notebooks_show_the_largest_values(solution, monkeypatch):
    monkeypatch.setattr("kerf.notebook.MOST_ELEMENTS_OF_PICTURE", 0)
    page = solution._repr_html_()
    assert f"{len(solution.tetrahedra):,}" in page and "max von Mises" in page and "data:image" not in page


def test_what_is_wrong_is_said(run, solution, tmp_path):
    with pytest.raises(kerf.UsageError, match="the case, line 1: .* has no 'yuong'"):
        kerf.solve(run, {"material": {"rubber": {"yuong": 1}}}, tmp_path / "out")
    with pytest.raises(TypeError, match=r"load\[0\].pressure of the case is nan"):
        kerf.solve(run, {"load": [{"pressure": float("nan")}]})
    with pytest.raises(TypeError, match="run is a int, but a Run, its folder"):
        kerf.solve(3, pulled_cube())
    with pytest.raises(kerf.FileError, match="nowhere"):
        kerf.solve("nowhere", pulled_cube())
    with pytest.raises(KeyError, match="no part 7; the numbers are 2, 3"):
        solution.part(7)
    with pytest.raises(kerf.FileError, match="is no folder of kerf solve"):
        kerf.Solution(run)
    assert not (tmp_path / "out").exists()

"""Rows of the tables of meshers, where a figure is unknown, and README's table, which names versions."""

import contextlib
import io
import pathlib
import sys
import unittest

import measured
import meshers
import python_modules
import readme
import regions

ROW = {"mesher": "HXT raw", "tets": 812, "seconds": 0.0, "wall_seconds": 0.01, "peak_bytes": 5e7, "dihedral_0": 9.5,
       "dihedral_0.1": 9.9, "dihedral_1": 12, "dihedral_5": 20, "dihedral_50": 60, "below_20_per_million": 3,
       "regions": 1, "region_error": 1e-9, "volume_error": 1e-9, "least_dihedral": 9.5, "lines": 12}
ANGLES = "9.5"


class Instant(meshers.Call):
    """Who is done before a clock of hundredths of a second has moved."""

    def call(self, measured, limit):
        return {"seconds": 0.0, "peak_bytes": 5e7, "tets": 812}


def printed(print_row, *arguments):
    with contextlib.redirect_stdout(io.StringIO()) as text:
        print_row(*arguments)
    return text.getvalue().split()


class UnknownRates(unittest.TestCase):
    def test_a_mesher_that_took_no_time_has_no_rate(self):
        call = Instant("HXT raw")
        for _ in range(3):
            call.run(type("Arguments", (), {"long": 12, "limit": 60}))
        result = call.result()
        self.assertIsNone(result["tets_per_second"])
        self.assertEqual(result["seconds"], 0)

    def test_its_row_has_dashes(self):
        case = meshers.Case(pathlib.Path("cube.stl"), 0, "cube")
        body = regions.Case("cube", [], 0)
        for rate, reference, told in ((None, 1e5, ["-", "-"]), (None, None, ["-", "-"]), (2e5, None, ["200,000", "-"])):
            row = ROW | {"tets_per_second": rate}
            for words in (printed(meshers.print_row, case, row, reference),
                          printed(regions.print_row, body, {"regions": 1}, row, reference),
                          printed(python_modules.print_row, "cube", row, reference)):
                first = words.index(told[0])
                self.assertEqual(words[first:first + 2], told)
                self.assertIn(ANGLES, words[first + 2:])

    def test_known_rates(self):
        self.assertEqual(measured.rate_of(10, 4), 2.5)
        self.assertEqual(measured.rate_text(1234567.8), "1,234,568")
        self.assertEqual(measured.ratio_text(3, 2), "1.50")
        self.assertEqual(measured.ratio_text(3, 2, 1), "1.5")


class ReadmesTable(unittest.TestCase):
    ROWS = [ROW | {"mesher": name, "tets": 3.3e6} for name in ("auto", "tetgen", "HXT raw")]
    MEASURED = {"versions": {"Kerf": "0.1.0", "TetGen": "1.5.0", "gmsh": "5.0"}, "repetitions": 3, "long": 12,
                "processor": "any", "date": "2026-11-29", "cases": [{"case": readme.CASE, "facets": 51840, "rows": [
                    *ROWS, {"mesher": "gmsh", "failure": "more than 9 s"}]}]}

    def test_it_names_versions_and_the_year_that_is_known(self):
        header = readme.table_of(self.MEASURED).splitlines()[0]
        self.assertEqual([cell.strip() for cell in header.split("|")[2:-1]],
                         ["Kerf 0.1.0", "TetGen 1.5.0 (2013)", "gmsh 5.0", "gmsh HXT", "HXT, optimised"])

    def test_each_mesher_has_a_figure_or_the_reason_why_not(self):
        cells = [cell.strip() for cell in readme.table_of(self.MEASURED).splitlines()[2].split("|")[1:-1]]
        self.assertEqual(cells, ["tetrahedra", "3.30 M", "3.30 M", "more than 9 s", "3.30 M", "not run"])

    def test_every_mesher_that_is_measured_has_a_column(self):
        self.assertEqual(set(readme.COLUMNS), {"auto", meshers.REFERENCE, *meshers.OF_GMSH})


if __name__ == "__main__":
    sys.exit(unittest.main())

#!/usr/bin/env python3
"""A page's session in Python is run, and prints what the page says.

session_test.py SOURCE PACKAGE PAGE

The lines with >>> of all ```python blocks are one session (doctest: `...` stands for anything), in a folder of
temporary files that has `part.stl` and `assets`. PACKAGE: the folder of the module kerf.
"""

import doctest
import os
import pathlib
import re
import shutil
import sys
import tempfile


def main():
    source, package, page = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    sys.path.insert(0, package)
    blocks = re.findall(r"^```python\n(.*?)^```$", (source / page).read_text(), re.M | re.S)
    with tempfile.TemporaryDirectory(prefix="kerf_session_") as folder:
        os.chdir(folder)
        pathlib.Path("tmp").mkdir()
        os.environ["TMPDIR"] = str(pathlib.Path("tmp").resolve())
        pathlib.Path("assets").symlink_to(source / "assets")
        shutil.copy(source / "assets/bearing_cap_14k.stl", "part.stl")
        session = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, page, page, 0)
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        failed, tried = runner.run(session)
        left = [path.name for path in pathlib.Path("tmp").iterdir()]
        os.chdir("/")
    if failed or not tried or left:
        sys.exit(f"session_test: {page}: {failed} of {tried} lines failed; left in the temporary folder: {left}")
    print(f"{page}: {tried} lines")


if __name__ == "__main__":
    main()

"""python3 -m kerf ARGUMENT...: the program kerf that belongs to this package."""

from __future__ import annotations

import os
import sys

from .programs import path


def main() -> None:
    """Becomes that program, with the arguments of the command line."""
    os.execv(path("kerf"), ["kerf", *sys.argv[1:]])


if __name__ == "__main__":
    main()

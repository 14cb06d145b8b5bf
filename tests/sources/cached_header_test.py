"""A compiler behind the cache of this build sees every change of a header.

usage: cached_header_test.py <compiler> [<word of the launcher>...]

An object that the cache keeps while a header of it has changed would let a broken tree pass. The headers of this test
change without another time or size, also below a precompiled header, and while they are compiled: that once served the
old object for the new header, as settings trusted the times of files. The cache of the test is its own and empty, the
settings are those of the build.
"""

import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

NOT_BUILT = 77
# A compiler that finds another header when it is done, where there is one for it.
SLOW_COMPILER = """#!/bin/sh
{compiler} "$@" || exit
for argument; do if [ "$argument" = -E ]; then exit; fi; done
if [ -f next.h ]; then mv next.h value.h; fi
"""


class Sources:
    """A program that ends with the value of its header, in a folder with a cache of its own."""

    def __init__(self, folder, launcher, compiler, precompiled):
        self.folder, self.launcher, self.precompiled = folder, launcher, precompiled
        self.environment = dict(os.environ, CCACHE_DIR=str(folder / "cache"))
        self.compiler = folder / "g++"  # a name that tells the cache what it is
        self.compiler.write_text(SLOW_COMPILER.format(compiler=shlex.quote(compiler)))
        self.compiler.chmod(0o755)
        include = "" if precompiled else '#include "value.h"\n'
        (folder / "main.cpp").write_text(include + "int main() { return value; }\n")
        (folder / "all.h").write_text('#include "value.h"\n')
        os.utime(folder / "all.h", (1_000_000_000, 1_000_000_000))

    def write(self, value, name="value.h"):
        (self.folder / name).write_text(f"constexpr int value = {value};\n")
        if name == "value.h":
            os.utime(self.folder / name, (1_000_000_000, 1_000_000_000))

    def run(self, *arguments):
        subprocess.run([*self.launcher, self.compiler, *arguments], check=True, cwd=self.folder, env=self.environment)

    def compiled_value(self):
        options = []
        if self.precompiled:
            self.run("-x", "c++-header", "-c", "all.h", "-o", "all.h.gch")
            options = ["-include", "all.h", "-Winvalid-pch", "-Werror"]
        self.run(*options, "-MD", "-MF", "main.d", "-c", "main.cpp", "-o", "main.o")
        subprocess.run([self.compiler, "main.o", "-o", "main"], check=True, cwd=self.folder)
        return subprocess.run([self.folder / "main"], check=False).returncode

    def hits(self):
        counts = subprocess.run([*self.launcher, "--print-stats"], check=True, text=True, capture_output=True,
                                env=self.environment).stdout
        return sum(int(line.split()[1]) for line in counts.splitlines()
                   if line.split()[0] in ("direct_cache_hit", "preprocessed_cache_hit"))


def check(launcher, compiler, precompiled):
    how = "precompiled" if precompiled else "included"
    with tempfile.TemporaryDirectory() as folder:
        sources = Sources(pathlib.Path(folder), launcher, compiler, precompiled)
        for value in (11, 22, 11):
            sources.write(value)
            assert sources.compiled_value() == value, f"the {how} header says {value}, and the object something else"
        assert sources.hits() > 0, f"nothing came from the cache, so that nothing was tested ({how})"
        sources.write(33)
        sources.write(44, "next.h")
        assert sources.compiled_value() in (33, 44)
        assert sources.compiled_value() == 44, f"the {how} header is 44, and the object is that of before, when it was 33"


def main():
    compiler, launcher = sys.argv[1], sys.argv[2:]
    if launcher[-1:] != ["ccache"]:
        print("this build has no cache")
        return NOT_BUILT
    for precompiled in (False, True):
        check(launcher, compiler, precompiled)
    return 0


sys.exit(main())

"""What pyproject.toml cannot say: the version, which CMake has, and that CMake builds the module and the programs."""

import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build import build
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
# The build tree of ./run, which is used again if it is for this Python.
TREE = ROOT / "build"


def version():
    """That of project(Kerf VERSION ...)."""
    return re.search(r"project\(Kerf VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def serves_this_python(tree):
    """Whether a build tree is one of these sources, and its module one for this Python."""
    cache = tree / "CMakeCache.txt"
    if not cache.is_file():
        return False
    lines = cache.read_text().splitlines()
    return (f"CMAKE_HOME_DIRECTORY:INTERNAL={ROOT}" in lines and
            f"KERF_PYTHON_ABI:INTERNAL={sysconfig.get_config_var('SOABI')}" in lines)


def missing_tools():
    """What has to come from the index where the system has it not."""
    tools = [name for name in ("cmake", "ninja") if not shutil.which(name)]
    folders = [Path(prefix, place, "pybind11") for prefix in ("/usr", "/usr/local", sys.prefix)
               for place in ("lib/cmake", "share/cmake")]
    if not any(folder.is_dir() for folder in folders) and importlib.util.find_spec("pybind11") is None:
        tools.append("pybind11 >= 2.10")
    return tools


def configure(tree):
    """A build tree without tests; the variable CMAKE_ARGS has more options for CMake, in a shell's words."""
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DKERF_JOIN_SOURCES=ON", "-DKERF_TESTS=OFF", "-DKERF_BENCHMARKS=OFF",
               f"-DPython3_EXECUTABLE={sys.executable}"]
    if shutil.which("ninja"):  # another one each time, where it comes from the index
        options += ["-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={shutil.which('ninja')}"]
    if importlib.util.find_spec("pybind11") is not None:
        import pybind11
        options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
    options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(tree), *options], check=True)
    if not serves_this_python(tree):
        raise SystemExit("setup.py: CMake has not found pybind11 or the headers of this Python. Install pybind11-dev "
                         "and python3-dev, or what your system calls them, and remove " + str(tree))


class FreshBuild(build):
    """Nothing of an earlier one stays in the package."""

    def run(self):
        shutil.rmtree(self.build_lib, ignore_errors=True)
        super().run()


class BuildByCMake(build_ext):
    """Puts the module and the programs that it starts into the package."""

    def run(self):
        tree = TREE
        if not serves_this_python(tree):
            tree = Path(self.build_temp).resolve()
            configure(tree)
        package = ROOT / "python/kerf" if self.inplace else Path(self.build_lib, "kerf").resolve()
        jobs = str(self.parallel or os.cpu_count())
        subprocess.run(["cmake", "--build", str(tree), "--target", "kerf_package", "-j", jobs], check=True)
        subprocess.run(["cmake", "--install", str(tree), "--component", "package", "--prefix", str(package), "--strip"],
                       check=True)


setup(
    version=version(),
    # Without sources: it makes a wheel one of this platform and this Python.
    ext_modules=[Extension("kerf._kerf", sources=[])],
    cmdclass={"build": FreshBuild, "build_ext": BuildByCMake},
    # build/ is CMake's; setuptools shall not share it.
    options={"build": {"build_base": "build/setuptools"}},
    setup_requires=missing_tools(),
)

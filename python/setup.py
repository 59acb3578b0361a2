"""Builds the C library by CMake, as ./run does, and puts it into the package.

ACENTRIC_BUILD_FOLDER names a build folder that CMake has configured, relative to the sources; without it, it is
build/release, which is configured where that has not been done. Nothing is written beside this file."""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

SOURCES = pathlib.Path(__file__).resolve().parent.parent
HEADER = SOURCES / "engine" / "capi" / "acentric_runtime.h"
GIVEN = os.environ.get("ACENTRIC_BUILD_FOLDER")
BUILD_FOLDER = SOURCES / (GIVEN or "build/release")
SET_UP = 'root=$1; source "$root/tools/setup.sh"; configure release OFF; build release acentric_runtime'


def version() -> str:
    numbers = dict(re.findall(r"#define ACENTRIC_RUNTIME_VERSION_(MAJOR|MINOR|PATCH) (\d+)", HEADER.read_text()))
    return "{MAJOR}.{MINOR}.{PATCH}".format(**numbers)


class BuildWithLibrary(build_py):
    def run(self) -> None:
        shutil.rmtree(self.build_lib, ignore_errors=True)  # modules that are gone
        super().run()
        if GIVEN:
            build = ["cmake", "--build", str(BUILD_FOLDER), "--target", "acentric_runtime"]
        else:
            build = ["bash", "-euc", SET_UP, "bash", str(SOURCES)]
        subprocess.run(build, check=True)
        library = f"libacentric_runtime.so.{version().split('.')[0]}"
        shutil.copy(BUILD_FOLDER / "lib" / library, pathlib.Path(self.build_lib) / "acentric" / library)


class WheelOfAnyPython(bdist_wheel):
    """The library is called by ctypes: the wheel is one of a machine, not of a version of Python."""

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    def has_ext_modules(self) -> bool:
        return True


if not HEADER.is_file():
    raise SystemExit(f"{HEADER} is missing: the package is built within the sources of Acentric, by pip install ./python")
if GIVEN and not (BUILD_FOLDER / "CMakeCache.txt").is_file():
    raise SystemExit(f"ACENTRIC_BUILD_FOLDER: CMake has configured nothing in {BUILD_FOLDER}")
made = BUILD_FOLDER / "python"
made.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    distclass=WithLibrary,
    cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelOfAnyPython},
    options={"build": {"build_base": str(made)}, "egg_info": {"egg_base": str(made)}},
)

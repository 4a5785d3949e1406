"""An installed wheel, tried with nothing but numpy beside it: check_wheel.py PROGRAM, that of the same environment.

A drive is simulated, mapped by the program and by Python, and judged. Neither may have loaded a library from the system
but those of the C and C++ runtimes.
"""

import ctypes  # noqa: F401
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy  # noqa: F401


def mapped_files():
    for line in Path("/proc/self/maps").read_text().splitlines():
        if "/" in line:
            yield line[line.index("/") :]


OF_PYTHON = set(mapped_files())  # libraries that Python itself takes from the system

import tilth  # noqa: E402
from tilth.program import PROGRAM  # noqa: E402

PACKAGE = Path(tilth.__file__).resolve().parent
RUNTIME = re.compile(r"(ld-linux-x86-64|lib(c|m|dl|rt|util|pthread|gcc_s|stdc\+\+|z|atomic))\.so")


def foreign(files):
    """Libraries of the system that are no part of a runtime."""
    ours = str(PACKAGE.parent), f"{sys.base_prefix}/lib/python"
    found = {file for file in files if ".so" in file and not file.startswith(ours)}
    return sorted(file for file in found if not RUNTIME.match(Path(file).name))


def needed_by(program):
    listed = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    assert "not found" not in listed, listed
    return re.findall(r"=> (\S+)", listed)


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        drive, ours, theirs = (Path(folder) / name for name in ("drive", "ours", "theirs"))
        tilth.simulate("plaza_fast", drive, duration=2, columns=900)
        run = tilth.run(drive, ours, loop_closure=True, truth=drive / "truth.tum")
        assert run.evaluation is not None and run.evaluation.ape.translation.max < 0.05, run.evaluation
        subprocess.run([program, "run", drive, "--out", theirs, "--loop-closure", "--quiet"], check=True)
        for name in ("trajectory.tum", "map.pcd"):
            assert (ours / name).read_bytes() == (theirs / name).read_bytes(), name
        assert (ours / "report.html").stat().st_size > 10_000
        with tempfile.NamedTemporaryFile(suffix=".las") as las:
            tilth.write_las(las.name, run.map)
        try:
            tilth.Odometry(no_such=1)
        except ValueError as error:
            assert "no_such" in str(error), error
        else:
            raise AssertionError("an unknown option was taken")
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    assert said == tilth.__version__ + "\n", said
    for loaded in (set(mapped_files()) - OF_PYTHON, needed_by(PROGRAM)):
        assert foreign(loaded) == [], foreign(loaded)
    print(f"Python {sys.version.split()[0]}: the wheel runs by itself, the program's bits and Python's are the same")


if __name__ == "__main__":
    main()

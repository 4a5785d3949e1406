"""The Python package by pytest: check_package.py FOLDER, in which the package lies as the build made it.

Where GTEST_OUTPUT names a folder (scripts/test), every case is written there for scripts/count_tests.py.
"""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))
from needs import needs  # noqa: E402

needs("numpy", "nanobind", "mypy")
pytest, = needs("pytest")


def main():
    package = Path(sys.argv[1])
    if not list((package / "tilth").glob("_tilth.*.so")):
        print(f"{package} has no extension module: configure again where nanobind and Python's headers are")
        return 1
    os.environ["PYTHONPATH"] = str(package)
    sys.path.insert(0, str(package))
    results = os.environ.get("GTEST_OUTPUT", "").removeprefix("xml:")
    report = [f"--junitxml={results}python_package.xml"] if results else []
    return pytest.main(["-q", "-p", "no:cacheprovider", "--durations=5", *report, str(ROOT / "tests/python")])


if __name__ == "__main__":
    sys.exit(main())

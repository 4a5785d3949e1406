"""What the tests share: a short recording with truth, what the program makes of it, and a scan."""

import subprocess
from pathlib import Path

import pytest

import tilth
from tilth.program import PROGRAM

ROOT = Path(__file__).resolve().parent.parent.parent


@pytest.fixture(scope="session")
def program():
    """Runs the program and returns what it printed."""

    def call(*arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=True).stdout

    return call


@pytest.fixture(scope="session")
def drive(tmp_path_factory):
    """The folder of a recording: 39 scans at 2 m/s with people, and truth.tum."""
    folder = tmp_path_factory.mktemp("drive") / "recording"
    tilth.simulate("plaza_fast", folder, seed=7, duration=4, columns=900)
    return folder


@pytest.fixture(scope="session")
def program_run(drive, program, tmp_path_factory):
    """The folder that `tilth run` made of the recording."""
    out = tmp_path_factory.mktemp("program")
    program("run", drive, "--out", out, "--quiet")
    return out


@pytest.fixture(scope="session")
def scan():
    """28,800 points, with rings, times and intensities."""
    return tilth.simulate("plaza", seed=3, duration=1)[5]

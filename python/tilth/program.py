"""The program ``tilth``, which the package brings along: its console script, and a way to call it from Python."""

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from tilth._tilth import Error

PROGRAM = Path(__file__).parent / "bin" / "tilth"


def main() -> NoReturn:
    """Becomes the program, with the arguments of this process."""
    os.execv(PROGRAM, ["tilth", *sys.argv[1:]])


def call(arguments: Sequence[str | os.PathLike[str]]) -> str:
    """Runs the program and returns what it printed. Raises tilth.Error with its message where it fails."""
    ended = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise Error(ended.stderr.strip().removeprefix("tilth: error: ") or f"tilth ended with {ended.returncode}")
    return ended.stdout

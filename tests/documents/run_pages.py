"""Runs the commands of the first pages of docs/ as they stand there: every block of sh, in order, in an empty folder a page.

run_pages.py TILTH    the program, which the commands find as `tilth`

A block below a comment `<!-- not run: why -->` is left out. A command that fails fails the test, as it would fail the reader.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = ("first_map.md", "own_recording.md", "tuning.md")
BLOCK = re.compile(r"^(?:<!-- not run: (?P<why>.+?) -->\n)?```sh\n(?P<commands>.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks_of(text):
    """The commands of each block, and why it is not run, None where it is."""
    found = [(match["commands"], match["why"]) for match in BLOCK.finditer(text)]
    assert len(found) == text.count("```sh\n"), "a block that is not understood"
    return found


def run(commands, folder, path):
    """Ends with the first command that fails, and shows what it said."""
    ended = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, env={**os.environ, "PATH": path},
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600, check=False)
    assert ended.returncode == 0, f"{commands}ended with {ended.returncode}:\n{ended.stdout}"
    return ended.stdout


def run_page(name, path):
    said = ""
    with tempfile.TemporaryDirectory() as folder:
        for commands, why in blocks_of((ROOT / "docs" / name).read_text()):
            if why is None:
                said += run(commands, folder, path)
    print(f"{name}: done", flush=True)
    return said


def check_the_runner(path):
    """A command in the middle that fails is noticed, and a block that is left out is left out."""
    text = "```sh\ntrue\n```\n<!-- not run: it fails -->\n```sh\nfalse\n```\n"
    assert blocks_of(text) == [("true\n", None), ("false\n", "it fails")]
    try:
        run("false\ntrue\n", ".", path)
    except AssertionError:
        return
    raise AssertionError("a command that fails is not noticed")


def main():
    with tempfile.TemporaryDirectory() as programs:
        (Path(programs) / "tilth").symlink_to(Path(sys.argv[1]).resolve())
        path = f"{programs}:{os.environ['PATH']}"
        check_the_runner(path)
        said = {name: run_page(name, path) for name in PAGES}
    assert re.search(r"^APE translation \[m\] +0\.00[012]", said["first_map.md"], re.MULTILINE), "about a millimetre, the page says"
    assert re.search(r"^ +verdict +good", said["first_map.md"], re.MULTILINE), said["first_map.md"]
    assert "the track was lost from" in said["tuning.md"], said["tuning.md"]


if __name__ == "__main__":
    main()

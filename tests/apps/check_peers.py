"""KISS-ICP from PyPI beside our own pipeline in one call of `tilth compare`, on the same scans.

check_peers.py TILTH
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
from needs import needs  # noqa: E402

needs("numpy", "kiss_icp")

SOURCE = "sim://auditorium?columns=900&duration=2"


def rows(tilth, out, *more):
    command = [tilth, "compare", "--source", SOURCE, "--pipelines", "tilth", "--out", str(out), "--python", sys.executable,
               "--align", "origin"]
    ended = subprocess.run([*command, *more], capture_output=True, text=True, timeout=300, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return json.loads((out / "comparison.json").read_text())["summary"]


def main():
    tilth = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        summary = rows(tilth, out, "--peers", "kiss_icp")
        ours, theirs = summary["rows"]
        assert theirs["method"] == "kiss_icp" and theirs["failed"] == 0, theirs
        assert 0 < theirs["ape_rmse_m"] < 0.5 and theirs["cpu_ms_mean"] > 0, theirs
        assert ours["ape_rmse_m"] < theirs["ape_rmse_m"], (ours, theirs)
        assert any("kiss-icp" in note for note in summary["notes"]), summary["notes"]
        before = (out / "runs").glob("*/*/done.json")
        times = {path: path.stat().st_mtime_ns for path in before}
        assert len(rows(tilth, out)["rows"]) == 1
        assert times == {path: path.stat().st_mtime_ns for path in times}, "a finished run was repeated"
        bad = subprocess.run([tilth, "compare", "--source", SOURCE, "--out", str(out), "--peers", "no_such"],
                             capture_output=True, text=True, check=False)
        assert bad.returncode == 1 and "--peers no_such" in bad.stderr, bad.stderr
    print("KISS-ICP and tilth on the same scans")


if __name__ == "__main__":
    main()

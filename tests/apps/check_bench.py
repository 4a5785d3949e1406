"""scripts/bench: a pipeline beside KISS-ICP from PyPI, on a simulated scene and on a folder of scans, in one call.

check_bench.py TILTH
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))
from needs import needs  # noqa: E402

needs("numpy", "kiss_icp")


def bench(tilth, out, *more):
    line = [sys.executable, ROOT / "scripts/bench", "--tilth", tilth, "--out", out, "--pipelines", "tilth", "--python",
            sys.executable, *more]
    return subprocess.run(line, capture_output=True, text=True, timeout=300, check=False)


def main():
    tilth = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        out, recording = Path(folder) / "out", Path(folder) / "recording"
        subprocess.run([tilth, "simulate", "auditorium", "--out", recording, "--duration", "1", "--set", "columns=900",
                        "--quiet"], check=True)
        ended = bench(tilth, out, "--quick", "--scenes", "auditorium", "--peers", "kiss_icp", "--recordings", recording)
        assert ended.returncode == 0, ended.stdout + ended.stderr
        rows = json.loads((out / "bench.json").read_text())["rows"]
        assert [row["method"] for row in rows] == ["tilth", "kiss_icp"] * 2, rows
        for ours, theirs in (rows[:2], rows[2:]):
            assert ours["source"] == theirs["source"] and ours["failed"] == theirs["failed"] == 0, (ours, theirs)
            ratio = ours["times_as_fast_as"]["kiss_icp"]
            assert abs(ratio * ours["cpu_ms_mean"] - theirs["cpu_ms_mean"]) < 1e-6 * theirs["cpu_ms_mean"], ours
            assert ratio > 1, (ours, theirs)
            assert 0 < ours["peak_megabytes"] < 200, ours
        assert rows[0]["error_over_best_peer"] < 1 and rows[2]["error_over_best_peer"] is None, rows
        assert (out / "bench.md").read_text() in ended.stdout
        assert [path.name for path in out.iterdir() if path.is_dir()] == [], "runs were left behind"
        bad = bench(tilth, out, "--peers", "no_such")
        assert bad.returncode == 1 and "--peers no_such" in bad.stderr, bad.stderr
    print("one pipeline and KISS-ICP, on a scene and on a recording")


if __name__ == "__main__":
    main()

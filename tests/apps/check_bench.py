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


def check_history(tilth, out):
    """The first measurement is kept, what is no worse passes, what is is named, other measurements are not compared."""
    file = out / "history.jsonl"
    line = ("--quick", "--scenes", "auditorium", "--peers", "", "--history", file)
    first = bench(tilth, out, *line)
    assert first.returncode == 0 and "the first measurement" in first.stdout, first.stdout + first.stderr
    kept = json.loads(file.read_text())
    assert kept["rows"][0]["ape_rmse_m"] > 0 and kept["machine"] and kept["commit"], kept
    slow, fast = ([{**row, "cpu_ms_mean": row["cpu_ms_mean"] * factor} for row in kept["rows"]] for factor in (100, 0.01))
    file.write_text(json.dumps(kept | {"rows": slow}) + "\n")
    better = bench(tilth, out, *line)
    assert better.returncode == 0 and "WORSE" not in better.stdout and "cpu_ms_mean" in better.stdout, better.stdout
    file.write_text(json.dumps(kept | {"rows": fast}) + "\n")
    worse = bench(tilth, out, *line)
    assert worse.returncode == 1 and worse.stdout.count("WORSE") == 1, worse.stdout
    other = bench(tilth, out, *line, "--seed", "302")
    assert other.returncode == 0 and "the first measurement" in other.stdout, other.stdout
    assert len(file.read_text().splitlines()) == 3
    file.unlink()


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
        check_history(tilth, out)
        bad = bench(tilth, out, "--peers", "no_such")
        assert bad.returncode == 1 and "--peers no_such" in bad.stderr, bad.stderr
    print("one pipeline and KISS-ICP, on a scene and on a recording")


if __name__ == "__main__":
    main()

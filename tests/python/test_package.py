"""The package as a user meets it: types, documents, examples, the program, drawings."""

import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import tilth

ROOT = Path(__file__).resolve().parent.parent.parent
PACKAGE = Path(tilth.__file__).parent


def python(*arguments, cwd=None):
    command = [sys.executable, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, check=True).stdout


def test_types_are_strict(tmp_path):
    user = tmp_path / "user.py"
    user.write_text(
        "import numpy as np\nimport tilth\nfrom numpy.typing import NDArray\n"
        "odometry = tilth.Odometry(max_range=50.0)\n"
        "result: tilth.Result = odometry.register_scan(np.zeros((9, 3)), stamp=1.0)\n"
        "pose: NDArray[np.float64] = result.T_world_lidar\n"
        "error: float = tilth.evaluate('a', 'b').ape.translation.rmse\n"
        "scans: list[tilth.Scan] = list(tilth.open('x'))\n"
    )
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path / "cache", PACKAGE, user]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=PACKAGE.parent, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_everything_public_says_what_it_is():
    undocumented = []
    for module in [tilth, *(importlib.import_module(f"tilth.{m.name}") for m in pkgutil.iter_modules([str(PACKAGE)]))]:
        if module.__name__ == "tilth.__main__":
            continue
        assert module.__doc__, module
        for name, thing in vars(module).items():
            if name.startswith("_") or not (inspect.isclass(thing) or inspect.isfunction(thing)):
                continue
            if not (thing.__module__ or "").startswith("tilth.") or thing.__module__ == "tilth._tilth":
                continue
            members = [(name, thing)] + [
                (f"{name}.{k}", v) for k, v in vars(thing).items() if not k.startswith("_") and not k.isupper()
            ] if inspect.isclass(thing) else [(name, thing)]
            undocumented += [
                f"{module.__name__}.{k}"
                for k, v in members
                if (inspect.isfunction(v) or isinstance(v, property) or inspect.isclass(v)) and not v.__doc__
            ]
    assert undocumented == []
    for thing in (tilth.Scan, tilth.Result, tilth.Registration):
        for name, member in vars(thing).items():
            assert name.startswith("_") or member.__doc__, f"{thing}.{name}"


def test_the_program_is_the_program(program, monkeypatch):
    expected = program("--version")
    assert python("-m", "tilth", "--version", cwd=PACKAGE.parent) == expected == tilth.__version__ + "\n"
    command = [sys.executable, "-m", "tilth", "run"]
    failed = subprocess.run(command, capture_output=True, check=False, cwd=PACKAGE.parent)
    assert failed.returncode == 106, "CLI11's, as the program's own"


def code_of(document, language="python"):
    text = (ROOT / document).read_text()
    return re.findall(rf"```{language}\n(.*?)```", text, flags=re.DOTALL)


@pytest.mark.parametrize("document", ["README.md", "docs/python.md"])
def test_the_documents_code_runs(document, drive, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    os.symlink(drive, "recording")
    blocks = code_of(document)
    assert blocks
    for block in blocks:
        exec(compile(block, document, "exec"), {"__name__": "__main__"})  # noqa: S102


def test_the_readme_needs_ten_lines():
    assert len([line for line in code_of("README.md")[0].splitlines() if line.strip()]) <= 10


def test_the_examples_run(drive, tmp_path):
    lines = python(ROOT / "examples/python/01_run_odometry.py", drive).splitlines()
    assert len(lines) == 39 and all(len(line.split()) == 13 for line in lines)
    told = python(ROOT / "examples/python/02_own_sensor_loop.py", tmp_path / "map.pcd")
    assert "tracking" in told and len(tilth.read_pcd(tmp_path / "map.pcd")) > 1000
    told = python(ROOT / "examples/python/03_compare_with_kiss_icp.py")
    ours, theirs = (float(re.search(r"APE ([\d.]+) m", line)[1]) for line in told.splitlines())
    assert ours < 0.02 and ours < theirs < 1, told
    told = python(ROOT / "examples/python/04_localize.py", tmp_path / "map")
    assert "located at" in told


def test_the_example_for_rerun_runs(drive, tmp_path):
    pytest.importorskip("rerun", reason="rerun-sdk is not installed")
    assert "39 poses" in python(ROOT / "examples/python/05_show_in_rerun.py", drive, tmp_path / "run.rrd")
    assert (tmp_path / "run.rrd").stat().st_size > 1e6


def test_the_example_for_open3d_runs(drive, tmp_path):
    pytest.importorskip("open3d", reason="open3d is not installed")
    told = python(ROOT / "examples/python/06_show_in_open3d.py", drive, tmp_path)
    assert "LineSet with 38 lines" in told and len(tilth.read_ply(tmp_path / "map.ply")) > 10_000


def test_every_example_is_tested():
    tested = Path(__file__).read_text()
    for example in (ROOT / "examples/python").iterdir():
        assert example.name in tested, example


def test_drawings(drive, program_run, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    from tilth import plot

    truth, estimate = (tilth.read_trajectory(f) for f in (drive / "truth.tum", program_run / "trajectory.tum"))
    axes = plot.trajectory(truth, estimate, labels=["truth", "Tilth"], view="xz")
    assert [line.get_label() for line in axes.get_lines()] == ["truth", "Tilth"]
    assert np.array_equal(axes.get_lines()[1].get_ydata(), estimate.positions[:, 2])
    drawn = plot.cloud(tilth.open(drive).__iter__().__next__().points, most=1000)
    assert 500 < len(drawn.collections[0].get_offsets()) <= 1000
    judged = tilth.evaluate(truth, estimate, align="se3", interpolate=True)
    assert plot.errors(judged).get_lines()[0].get_ydata().max() == pytest.approx(judged.ape.translation.max)
    with pytest.raises(tilth.Error, match="view: is 'zx'"):
        plot.trajectory(truth, view="zx")
    with pytest.raises(tilth.Error, match="points: has shape"):
        plot.cloud(np.zeros(3))


def test_studies_are_the_programs(tmp_path):
    source = "sim://auditorium?columns=450&duration=2"
    figures = tilth.compare([source], tmp_path / "c", pipelines=["tilth", "floam"], seeds="1-2", align="origin", jobs=1)
    assert [row["method"] for row in figures["summary"]["rows"]] == ["tilth", "floam"]
    assert len(figures["runs"]["rows"]) == 4 and all(row["failed"] == 0 for row in figures["summary"]["rows"])
    swept = tilth.sweep({"max_range": [20, 50.0]}, [source], tmp_path / "s", jobs=1)
    assert swept
    with pytest.raises(tilth.Error, match="no_such"):
        tilth.compare([source], tmp_path / "c", pipelines=["no_such"])


def test_a_notebook_shows_the_report(drive, program_run):
    from html.parser import HTMLParser

    from tilth import notebook

    class Frame(HTMLParser):
        page = ""

        def handle_starttag(self, tag, attributes):
            self.page = dict(attributes).get("srcdoc", "")

    frame = Frame()
    frame.feed(notebook.view(program_run, height=500)._repr_html_())
    assert frame.page == (program_run / "report.html").read_text()
    with pytest.raises(tilth.Error, match="run: has no files"):
        notebook.view(tilth.run(drive, max_scans=2))
    with pytest.raises(tilth.Error, match="report.html: is missing"):
        notebook.view(drive)

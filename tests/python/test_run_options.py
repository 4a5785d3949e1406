"""What `tilth run` can be asked for and what tilth.run can be asked for: the same, with the same files."""

import inspect
import re
import urllib.request

import pytest

import tilth

NOT_IN_PYTHON = {"help": "help(tilth.run)", "set": "keyword arguments", "quiet": "nothing is printed unless asked for"}
RENAMED = {"calib": "calibration"}
ONLY_IN_PYTHON = {
    "source": "a positional of the program",
    "options": "of --set",
    "loop": "of --set loop.",
    "localize": "of --set localize.",
    "outputs": "a flag each",
    "progress": "a line on a terminal",
}


def bytes_of(folder):
    """Of each file in it, but for its lock."""
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file() and p.name != ".lock"}


@pytest.fixture(scope="module")
def flags(program):
    """Of `tilth run`, as Python would spell them."""
    found = set(re.findall(r"^ {2}(?:-h,)?--([a-z-]+)", program("run", "--help"), flags=re.MULTILINE))
    return {RENAMED.get(flag, flag.replace("-", "_")) for flag in found}


def test_every_flag_of_the_program_is_an_argument(flags, drive):
    arguments, of_source = (set(inspect.signature(f).parameters) for f in (tilth.run, tilth.open))
    options = tilth.run(drive, max_scans=1).summary["options"]
    of_source |= {key.removeprefix("source.") for key in options if key.startswith("source.")}
    missing = []
    for flag in sorted(flags - arguments - of_source - set(NOT_IN_PYTHON)):
        with pytest.raises(tilth.Error, match=flag) as refused:
            tilth.run(drive, outputs={flag: "?"}, max_scans=1)
        if "is not known" in str(refused.value):
            missing.append(flag)
    assert missing == [] and len(flags) > 40


def test_every_argument_is_a_flag_of_the_program(flags):
    assert set(inspect.signature(tilth.run).parameters) - flags == set(ONLY_IN_PYTHON)
    assert set(NOT_IN_PYTHON) <= flags


def test_a_level_run_is_the_programs(drive, program, tmp_path):
    run = tilth.run(drive, tmp_path / "ours", level=True)
    program("run", drive, "--level", "--out", tmp_path / "theirs")
    for name in ("trajectory.tum", "map.pcd"):
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes(), name
    assert run.summary["options"]["level"] == "true"


@pytest.fixture(scope="module")
def wheels(drive, tmp_path_factory):
    """The true way as another source tells of it: 3 % too long, in a frame of its own."""
    truth = tilth.read_trajectory(drive / "truth.tum")
    poses = truth.poses.copy()
    poses[:, :3, 3] *= 1.03
    file = tmp_path_factory.mktemp("wheels") / "wheels.tum"
    tilth.Trajectory(truth.stamps, poses).save(file)
    return file


def test_a_prior_is_the_programs(drive, wheels, program, tmp_path):
    run = tilth.run(drive, tmp_path / "ours", prior=wheels)
    program("run", drive, "--prior", wheels, "--out", tmp_path / "theirs")
    theirs = (tmp_path / "theirs/trajectory.tum").read_bytes()
    assert (tmp_path / "ours/trajectory.tum").read_bytes() == theirs
    assert run.summary["options"]["source.prior"] == str(wheels)
    for prior in (wheels, tilth.read_trajectory(wheels)):
        for made in (tilth.Odometry(prior=prior), tilth.Slam(prior=prior)):
            results = [made.register_scan(scan) for scan in tilth.open(drive)]
            tilth.Trajectory([r.stamp for r in results], [r.T_world_lidar for r in results]).save(tmp_path / "fed.tum")
            assert (tmp_path / "fed.tum").read_bytes() == theirs


def test_a_prior_of_another_clock_is_noticed(drive, wheels, tmp_path):
    late = tilth.read_trajectory(wheels)
    tilth.Trajectory(late.stamps + 1000, late.poses).save(tmp_path / "late.tum")
    assert any("by the clock of the scans" in text for text in tilth.run(drive, prior=tmp_path / "late.tum").notices)


def test_a_configuration_is_heard(drive, program, tmp_path):
    (tmp_path / "a.yaml").write_text("pipeline: floam\nmax_range: 40\nloop:\n  keyframe:\n    distance: 0.5\n")
    run = tilth.run(drive, config=tmp_path / "a.yaml", loop_closure=True, max_range=30, max_scans=8)
    assert run.summary["pipeline"] == "floam"
    assert float(run.summary["options"]["max_range"]) == 30, "what is given here is stronger"
    assert float(run.summary["options"]["loop.keyframe.distance"]) == 0.5
    named = tilth.run(drive, config=tmp_path / "a.yaml", pipeline="tilth", max_scans=1)
    assert named.summary["pipeline"] == "tilth"


def test_moving_things_may_stay(drive):
    cleaned, whole = (tilth.run(drive, outputs={"keep_moving": keep}) for keep in (False, True))
    assert len(cleaned.map) < len(whole.map)


def test_a_map_is_saved_and_goes_on_as_the_programs(drive, program, tmp_path):
    first = tilth.run(drive, save_map=tmp_path / "ours")
    program("run", drive, "--out", tmp_path / "a", "--save-map", tmp_path / "theirs")
    assert bytes_of(tmp_path / "ours") == bytes_of(tmp_path / "theirs") != {}
    assert len(first.trajectory) == 39
    again = {"map": tmp_path / "ours", "save_map": tmp_path / "ours2", "localize": {"min_fit": 0.3}}
    tilth.run(drive, **again)
    program("run", drive, "--out", tmp_path / "b", "--map", tmp_path / "theirs", "--save-map", tmp_path / "theirs2",
            "--set", "localize.min_fit=0.3")
    assert bytes_of(tmp_path / "ours2") == bytes_of(tmp_path / "theirs2") != {}
    assert len(tilth.Localizer(tmp_path / "ours2").add(next(iter(tilth.open(drive)))).hypotheses) == 0


def test_browsers_may_watch(drive, capsys):
    pages = []

    def look(scans, total):
        if not pages:
            address = re.search(r"http://127\.0\.0\.1:\d+/", capsys.readouterr().err)[0]
            pages.append(urllib.request.urlopen(address, timeout=20).read())  # noqa: S310

    tilth.run(drive, max_scans=3, view=0, progress=look)
    assert b"<html" in pages[0].lower() or b"<!doctype" in pages[0].lower()
    tilth.run(drive, max_scans=1)
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"map": "/no/map"}, "map: .* needs save_map"),
        ({"map": "/no/map", "save_map": "/tmp/never", "level": True}, "excludes level"),
        ({"map": "/no/map", "save_map": "/tmp/never"}, "/no/map"),
        ({"prior": "/no/wheels.tum"}, "/no/wheels.tum"),
        ({"config": "/no/config.yaml"}, "/no/config.yaml"),
        ({"localize": {"no_such": 1}}, "localize.no_such"),
        ({"view": 70000}, "view: is 70000"),
        ({"view": 0, "view_host": "nobody"}, "nobody"),
    ],
)
def test_wrong_requests_are_refused_before_the_first_scan(arguments, message, drive):
    with pytest.raises(tilth.Error, match=message):
        tilth.run(drive, **arguments)


def test_priors_that_are_none_are_refused(drive, wheels):
    with pytest.raises(tilth.Error, match="prior: names no file"):
        tilth.Odometry(prior="")
    with pytest.raises(tilth.Error, match="prior"):
        tilth.Odometry(prior=tilth.read_trajectory(wheels)[:1])
    with pytest.raises(tilth.Error, match="prior|motion"):
        tilth.Odometry("floam", prior=wheels)

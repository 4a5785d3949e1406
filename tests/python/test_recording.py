"""Recordings, whole runs and simulations."""

import json
import os
import signal
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import tilth


def test_a_recording_is_read_as_the_program_reads_it(drive, program):
    recording = tilth.open(drive)
    assert len(recording) == 39
    scans = list(recording)
    assert len(scans) == 39 and [s.stamp for s in scans] == sorted(s.stamp for s in scans)
    told = program("info", drive)
    assert recording.decisions and all(sentence in told for sentence in recording.decisions)
    assert recording.contents and recording.skipped == [] and recording.notices == []
    assert scans[0].points.dtype == np.float64 and scans[0].times.dtype == np.float32
    assert scans[0].rings.dtype == np.uint16 and scans[0].rings.max() == 15


def test_a_second_loop_begins_anew(drive):
    recording = tilth.open(drive)
    assert next(iter(recording)).stamp == next(iter(recording)).stamp
    assert [s.stamp for s in recording] == [s.stamp for s in recording]


def test_bad_records_are_listed(drive, tmp_path):
    for i, file in enumerate(sorted((drive / "scans").glob("*.pcd"))[:5]):
        (tmp_path / file.name).write_bytes(b"no points" if i == 3 else file.read_bytes())
    recording = tilth.open(tmp_path)
    assert len(list(recording)) == 4
    (skipped,) = recording.skipped
    assert skipped.index == 3 and "000003.pcd" in skipped.where and skipped.what


def test_the_length_of_a_capture_is_not_known(tmp_path):
    tilth.simulate("corridor", tmp_path, format="pcap", duration=0.5)
    (capture,) = tmp_path.glob("*.pcap")
    recording = tilth.open(capture)
    with pytest.raises(TypeError, match="is not known before its end"):
        len(recording)
    assert len(list(recording)) >= 3


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"source": "/no/such/folder"}, "/no/such/folder"),
        ({"source": "sim://no_such_scene"}, "no_such_scene"),
        ({"source": "sim://corridor", "rate": -1}, "rate: is -1"),
        ({"source": "sim://corridor", "modell": "vlp16"}, "modell"),
    ],
)
def test_what_cannot_be_opened_is_named(arguments, message):
    with pytest.raises(tilth.Error, match=message):
        list(tilth.open(**arguments))


def timeless(folder):
    """What summary.json says of a run that is the same for every run."""
    summary = json.loads((folder / "summary.json").read_text())
    return {key: summary[key] for key in ("options", "decisions", "version", "pipeline")}


def test_a_run_makes_the_programs_files(drive, program_run, tmp_path):
    run = tilth.run(drive, tmp_path / "out")
    ours, theirs = ({p.name for p in folder.iterdir()} for folder in (tmp_path / "out", program_run))
    assert ours == theirs
    for name in ("trajectory.tum", "map.pcd"):
        assert (tmp_path / "out" / name).read_bytes() == (program_run / name).read_bytes(), name
    assert timeless(tmp_path / "out") == timeless(program_run)
    assert run.summary["options"] == timeless(program_run)["options"]
    assert run.ended == "end of input" and run.lost == "" and run.skipped == [] and run.closures == []
    assert np.array_equal(run.map[:, 2], tilth.read_pcd(program_run / "map.pcd")["z"])
    assert len(run.scans["stamp"]) == 39 and set(run.scans["track"]) == {"tracking"}
    assert np.array_equal(run.scans["stamp"], run.trajectory.stamps)


def test_a_run_gives_poses_of_the_base(drive, program, tmp_path):
    mount = "0.3,0,0.8,0,5,90"
    run = tilth.run(drive, tmp_path / "ours", base_from_lidar=mount)
    program("run", drive, "--base-from-lidar", mount, "--out", tmp_path / "theirs")
    assert (tmp_path / "ours/trajectory.tum").read_bytes() == (tmp_path / "theirs/trajectory.tum").read_bytes()
    assert np.allclose(run.trajectory.poses[0], np.eye(4), atol=1e-3)
    with pytest.raises(tilth.Error, match="base_from_lidar 1,2"):
        tilth.run(drive, base_from_lidar="1,2")


def test_a_run_without_files_has_the_same_bits(drive, program_run, tmp_path):
    run = tilth.run(tilth.open(drive), threads=1)
    run.trajectory.save(tmp_path / "ours.tum")
    assert (tmp_path / "ours.tum").read_bytes() == (program_run / "trajectory.tum").read_bytes()
    run.save_map(tmp_path / "ours.pcd")
    assert (tmp_path / "ours.pcd").read_bytes() == (program_run / "map.pcd").read_bytes()


def test_a_run_is_judged(drive, program, tmp_path):
    run = tilth.run(drive, loop_closure=True, truth=drive / "truth.tum", outputs={"map_voxel": 0.2})
    flags = ["--loop-closure", "--truth", drive / "truth.tum", "--map-voxel", "0.2"]
    program("run", drive, "--out", tmp_path, "--quiet", *flags)
    theirs = json.loads((tmp_path / "summary.json").read_text())
    assert run.evaluation.as_dict()["ape"] == theirs["evaluation"]["ape"]
    assert run.evaluation.ape.translation.max < 0.05
    run.save_map(tmp_path / "ours.pcd")
    assert (tmp_path / "ours.pcd").read_bytes() == (tmp_path / "map.pcd").read_bytes()


def test_progress_is_told(drive):
    told = []
    tilth.run(drive, max_scans=5, progress=lambda scans, total: told.append((scans, total)))
    assert told == [(i, 39) for i in range(1, 6)]
    tilth.run(drive, max_scans=2, progress=True)


def test_what_progress_raises_ends_the_run(drive):
    def stop(scans, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tilth.run(drive, progress=stop)


def test_a_lost_track_warns(tmp_path):
    tilth.simulate("corridor", tmp_path, duration=2.2)
    stamps = np.loadtxt(tmp_path / "times.txt")
    stamps[10:] += 30
    np.savetxt(tmp_path / "times.txt", stamps, fmt="%.9f")
    with pytest.warns(tilth.TrackLostWarning, match="the track was lost from"):
        run = tilth.run(tmp_path)
    assert run.lost and "LOST ITS WAY" in repr(run) and "recovered" in set(run.scans["track"])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"outputs": {"map_voxl": 0.1}}, "map_voxl"),
        ({"outputs": {"map_voxel": 0}}, "map_voxel"),
        ({"outputs": {"map_format": "obj"}, "out": "/tmp/never"}, "obj"),
        ({"loop": {"no_such": 1}}, "loop.no_such"),
        ({"truth": "/no/truth.tum"}, "/no/truth.tum"),
        ({"beams": "/no/beams.yaml"}, "/no/beams.yaml"),
        ({"max_scans": -1}, "max_scans, threads: are -1"),
        ({"out": "/proc/no/folder"}, "/proc/no"),
        ({"no_such": 1}, "no_such"),
    ],
)
def test_wrong_runs_are_refused_before_the_first_scan(arguments, message, drive):
    with pytest.raises(tilth.Error, match=message):
        tilth.run(drive, **arguments)


def test_ctrl_c_ends_a_run_and_keeps_what_there_is(tmp_path):
    script = textwrap.dedent(
        f"""
        import os, signal, tilth
        def at(scans, total):
            if scans == 5: os.kill(os.getpid(), signal.SIGINT)
        try:
            tilth.run("sim://corridor?columns=450", {str(tmp_path)!r}, progress=at)
        except KeyboardInterrupt:
            print("interrupted")
        """
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)
    assert ended.stdout == "interrupted\n"
    assert 5 <= len(tilth.read_trajectory(tmp_path / "trajectory.tum")) < 10


def test_ctrl_c_ends_the_wait_for_a_sensor():
    script = "import tilth\nprint('ready', flush=True)\nfor scan in tilth.open('udp://127.0.0.1:0'): pass"
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    try:
        with pytest.raises(subprocess.TimeoutExpired):
            child.wait(0.7)
        os.kill(child.pid, signal.SIGINT)
        assert child.wait(20) != 0 and "KeyboardInterrupt" in child.stderr.read()
    finally:
        child.kill()
        child.communicate()


def test_a_simulation_is_the_programs(drive):
    simulation = tilth.simulate("plaza_fast", seed=7, duration=4, columns=900)
    assert len(simulation) == 39 and len(simulation.labels(3)) == len(simulation[3])
    first = next(iter(tilth.open(drive)))
    assert np.array_equal(simulation[0].points.astype(np.float32), first.points.astype(np.float32))
    assert np.array_equal(simulation[-1].points, simulation[38].points)
    truth = tilth.read_trajectory(drive / "truth.tum")
    assert simulation.truth.poses == pytest.approx(truth.poses, abs=1e-8)
    with pytest.raises(IndexError):
        simulation[39]
    with pytest.raises(tilth.Error, match="no_such"):
        tilth.simulate("no_such")
    with pytest.raises(tilth.Error, match="format"):
        tilth.simulate("corridor", drive / "never", format="obj")

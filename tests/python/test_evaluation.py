"""Trajectories and their judge: the program's figures, and evo's."""

import json

import numpy as np
import pytest

import tilth


def flags(options):
    for key, value in options.items():
        flag = "--" + key.replace("_", "-")
        yield from ([flag] if value is True else [flag, str(value)])


@pytest.mark.parametrize(
    "options",
    [
        {"align": "se3", "interpolate": True},
        {"align": "origin", "interpolate": True, "rpe_delta": 2, "rpe_unit": "m"},
        {"align": "sim3", "max_dt": 0.5, "all_pairs": True},
    ],
)
def test_figures_are_the_programs(options, drive, program_run, program, tmp_path):
    truth, estimate = drive / "truth.tum", program_run / "trajectory.tum"
    table = program("evaluate", truth, estimate, *flags(options), "--json", tmp_path / "theirs.json")
    ours = tilth.evaluate(truth, estimate, **options)
    assert ours.as_dict() == json.loads((tmp_path / "theirs.json").read_text()) and str(ours) == table
    in_memory = tilth.evaluate(tilth.read_trajectory(truth), tilth.read_trajectory(estimate), **options)
    assert in_memory.as_dict()["ape"] == ours.as_dict()["ape"] and in_memory.as_dict()["rpe"] == ours.as_dict()["rpe"]
    errors = ours.ape.translation_errors
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(ours.ape.translation.rmse, rel=1e-12)
    gaps = np.linalg.norm(ours.truth.positions - ours.estimate.positions, axis=1)
    assert gaps == pytest.approx(errors, abs=1e-9) or options.get("align") == "sim3"


def test_evo_finds_the_same(drive, program_run):
    from evo.core import metrics, sync

    truth, estimate = tilth.read_trajectory(drive / "truth.tum"), tilth.read_trajectory(program_run / "trajectory.tum")
    reference, aligned = sync.associate_trajectories(truth.to_evo(), estimate.to_evo(), max_diff=0.01)
    aligned.align(reference)
    ape = metrics.APE(metrics.PoseRelation.translation_part)
    ape.process_data((reference, aligned))
    ours = tilth.evaluate(truth, estimate, align="se3", max_dt=0.01)
    assert ours.ape.translation.rmse == pytest.approx(ape.get_statistic(metrics.StatisticsType.rmse), rel=1e-9)
    back = tilth.Trajectory.from_evo(estimate.to_evo())
    assert np.array_equal(back.stamps, estimate.stamps) and back.poses == pytest.approx(estimate.poses, abs=1e-12)


def test_a_trajectory_reads_back_what_it_wrote(program_run, tmp_path):
    trajectory = tilth.read_trajectory(program_run / "trajectory.tum")
    assert trajectory.length > 1 and "39 poses" in repr(trajectory)
    for form in ("tum", "kitti"):
        trajectory.save(tmp_path / form, form)
        assert tilth.read_trajectory(tmp_path / form).poses == pytest.approx(trajectory.poses, abs=1e-12)
    with pytest.raises(tilth.Error, match="format: is 'bvh'"):
        trajectory.save(tmp_path / "x", "bvh")
    assert len(trajectory[5:15]) == 10 and [stamp for stamp, _ in trajectory] == list(trajectory.stamps)
    assert len(tilth.Trajectory([], np.empty((0, 4, 4)))) == 0


TURNED = np.diag([1.0, 1.0, -1.0, 1.0])


@pytest.mark.parametrize(
    ("stamps", "poses", "message"),
    [
        ([1.0, 1.0], [np.eye(4)] * 2, r"trajectory.stamps\[1\]: is 1.0+, expected stamps \[s\] that ascend"),
        ([1.0, np.nan], [np.eye(4)] * 2, r"trajectory.stamps\[1\]"),
        ([1.0], [np.eye(4)] * 2, r"trajectory.stamps: has the shape \(1,\), expected \(2,\)"),
        ([1.0, 2.0], [np.eye(4), TURNED], r"trajectory.poses\[1\]: is no rigid motion"),
        ([1.0, 2.0], [np.eye(4), 2 * np.eye(4)], r"trajectory.poses\[1\]: is no rigid motion"),
        ([1.0], [np.eye(3)], r"trajectory.poses: has the shape \(1, 3, 3\), expected \(n, 4, 4\)"),
    ],
)
def test_what_is_no_trajectory_is_refused(stamps, poses, message):
    with pytest.raises(tilth.Error, match=message):
        tilth.Trajectory(stamps, poses)


def test_wrong_evaluations_are_refused(program_run):
    trajectory = tilth.read_trajectory(program_run / "trajectory.tum")
    with pytest.raises(tilth.Error, match="algn"):
        tilth.evaluate(trajectory, trajectory, algn="se3")
    with pytest.raises(tilth.Error, match="/no/such.tum"):
        tilth.evaluate("/no/such.tum", trajectory)
    with pytest.raises(tilth.Error, match="calibration: is for a truth on file"):
        tilth.evaluate(trajectory, trajectory, calibration="calib.txt")
    with pytest.raises(tilth.Error, match="match"):
        tilth.evaluate(trajectory, tilth.Trajectory(trajectory.stamps + 1e6, trajectory.poses))

"""A saved map from Python: the poses are the program's, and what is not known is None."""

import numpy as np
import pytest

import tilth


def pose_at(trajectory, stamp):
    """The pose next to it; that of a simulation has hundreds a second."""
    return trajectory.poses[np.abs(trajectory.stamps - stamp).argmin()]


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """A map that Slam made of a drive, the drive's truth at its origin, and another drive through the same world."""
    world = {"world_seed": 5, "columns": 600}
    mapped = tilth.simulate("office", seed=31, duration=14, **world)
    driven = tilth.simulate("office", seed=32, duration=7, **world)
    slam = tilth.Slam()
    for scan in mapped:
        slam.register_scan(scan)
    folder = tmp_path_factory.mktemp("saved") / "map"
    slam.save_map(folder)
    return folder, slam, mapped, driven


def test_another_drive_is_found(saved):
    folder, slam, mapped, driven = saved
    T_truth_map = pose_at(mapped.truth, slam.trajectory().stamps[0])
    localizer = tilth.Localizer(folder)
    located = [localizer.add(scan) for scan in driven]
    known = [l for l in located if l.T_map_lidar is not None]
    assert located[0].state == "searching" and located[0].T_map_lidar is None
    assert known and known[-1].state == "located" and known[-1].overlap > 0.5
    for l in known:
        error = np.linalg.inv(T_truth_map @ l.T_map_lidar) @ pose_at(driven.truth, l.stamp)
        assert np.linalg.norm(error[:3, 3]) < 0.05
        assert l.covariance.shape == (6, 6) and np.all(np.diagonal(l.covariance) > 0)
    assert all(l.hypotheses.shape[1:] == (4, 4) for l in located)
    assert located[3].odometry.track == "tracking"


def test_poses_are_the_programs(saved, program, tmp_path):
    folder, _, _, _ = saved
    program("localize", "sim://office?seed=32&duration=7&world_seed=5&columns=600", "--map", folder, "--out", tmp_path,
            "--quiet")
    theirs = tilth.read_trajectory(tmp_path / "trajectory.tum")
    localizer = tilth.Localizer(folder)
    ours = [localizer.add(scan) for scan in tilth.simulate("office", seed=32, duration=7, world_seed=5, columns=600)]
    ours = [l for l in ours if l.T_map_lidar is not None]
    assert len(ours) == len(theirs) > 20
    assert np.abs(np.array([l.T_map_lidar for l in ours]) - theirs.poses).max() < 1e-12


def test_a_guess_is_heard_and_forgotten(saved):
    folder, _, mapped, _ = saved
    localizer = tilth.Localizer(folder, np.eye(4), localize={"first_after": 0.2})
    states = [localizer.add(scan).state for scan in list(mapped)[:8]]
    assert states[-1] == "located"
    localizer.forget()
    assert localizer.add(mapped[0]).state == "searching"


@pytest.mark.parametrize(
    "arguments, options, message",
    [
        (("none",), {}, "is no folder of a map"),
        ((), {"T_map_lidar": np.ones((3, 3))}, "T_map_lidar"),
        ((), {"localize": {"no_such": 1}}, "localize.no_such"),
        ((), {"pipeline": "none"}, "none"),
        ((), {"max_range": -1}, "max_range"),
    ],
)
def test_what_is_wrong_is_refused(saved, arguments, options, message):
    with pytest.raises(tilth.Error, match=message):
        tilth.Localizer(*(arguments or (saved[0],)), **options)


def test_stamps_must_ascend(saved):
    folder, _, _, driven = saved
    localizer = tilth.Localizer(folder)
    localizer.add(driven[1])
    with pytest.raises(tilth.Error, match="stamp"):
        localizer.add(driven[0])

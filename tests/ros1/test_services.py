"""What the node can be asked for: parameters, the map, a new beginning, its place in a map."""

import numpy as np
import pytest
from conftest import KEEP_ALL, PATIENCE, Peer, call, diagnosed, drive, play, start, stop, until
from simulated_truth import errors_in_map


def position(message):
    at = message.pose.pose.position
    return np.array([at.x, at.y, at.z])


@pytest.mark.parametrize(
    "parameter, value, expected",
    [
        ("queue", 0, "a value in 1 .. 1000"),
        ("loop/keyframe/distance", -1.5, "loop.keyframe.distance"),
        ("map_voxle", 1.0, "map_voxle"),
        ("base_from_lidar", "1,2", "base_from_lidar"),
        ("queue", [1, 2], "is a list"),
        ("loop_closure", "perhaps", "true or false"),
        ("map", "/nowhere", "/nowhere"),
    ],
)
def test_what_is_wrong_is_refused_with_its_name(parameter, value, expected):
    process = start({parameter: value})
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and expected in said, said


def test_the_map_is_saved_and_a_new_one_begun(peer, recording, run, tmp_path):
    process = start({**KEEP_ALL, "loop_closure": True, "save_map": f"{tmp_path}/map"})
    nothing = call("/tilth/save_map")
    assert not nothing.success and "no scan" in nothing.message
    until(peer.connected, "all topics are there")
    play(recording, 5)
    heard, count = peer.heard["/tilth/odometry"], len(run[""])
    until(lambda: len(heard) >= count, "all poses")
    saved = call("/tilth/save_map")
    assert saved.success, saved.message
    assert len((tmp_path / "map/trajectory.tum").read_text().splitlines()) == count
    assert (tmp_path / "map/map.pcd").stat().st_size > 100_000
    assert any((tmp_path / "map/places").iterdir())
    assert not call("/tilth/localize").success, "it has no map to be found in"
    assert call("/tilth/reset").success
    play(recording, 5, "--start", "5")
    until(lambda: len(heard) > count, "it begins anew")
    assert np.linalg.norm(position(heard[count])) < 0.3, "the world begins at its first scan"
    assert stop(process)[0] == 0


def test_a_recording_that_is_played_again_begins_anew(peer, sim_time, recording, run):
    process = start(KEEP_ALL)
    until(peer.connected, "all topics are there")
    play(recording, 5)
    heard, count = peer.heard["/tilth/odometry"], len(run[""])
    until(lambda: len(heard) >= count, "poses")
    play(recording, 5)
    until(lambda: len(heard) > count, "it begins anew")
    code, said = stop(process)
    assert code == 0 and "the stamps of the clouds fall back" in said
    assert np.linalg.norm(position(heard[count])) < 0.3, "the world begins at its first scan"


def saved_map(peer, bag, folder):
    """Of the drive, by the service."""
    process = start({**KEEP_ALL, "loop_closure": True, "save_map": str(folder)})
    until(peer.connected, "all topics are there")
    play(bag, 2)
    until(lambda: len(peer.heard["/tilth/odometry"]) > 90, "nearly all poses")
    saved = call("/tilth/save_map")
    assert saved.success, saved.message
    stop(process)
    return folder


def test_it_is_found_in_a_map_that_was_saved(peer, tmp_path):
    first, second = drive(tmp_path / "first", 5, 5.0, 15.0), drive(tmp_path / "second", 6, 7.0, 13.0)
    saved = saved_map(peer, first, tmp_path / "map")
    peer.close()
    process = start({**KEEP_ALL, "map": str(saved / "places")})
    located = Peer()
    until(located.connected, "all topics are there")
    play(second, 1, "--duration", "3")
    heard = located.heard["/tf"]
    until(lambda: len(heard) >= 28, lambda: f"{len(heard)} transforms")
    answer = call("/tilth/localize")
    assert answer.success and "was located" in answer.message, answer.message
    asked = len(heard)
    play(second, 1, "--start", "3")
    until(lambda: len(heard) >= asked + 28, lambda: f"{len(heard)} transforms")
    until(lambda: diagnosed(located, "place") == "located", "it says where")
    assert stop(process)[0] == 0
    assert [t.child_frame_id for t in heard[0].transforms] == ["lidar"], "nothing is claimed"
    assert [t.child_frame_id for t in heard[asked].transforms] == ["lidar"], "nor when it was asked to search anew"
    errors = errors_in_map(heard, saved, first.parent, second.parent)
    print(f"{len(errors)} of {len(heard)} poses in the map, {max(errors):.4f} m from the truth at most")
    assert len(errors) > len(heard) / 2 and max(errors) < 0.05
    (whole,) = located.heard["/tilth/map"]
    assert whole.header.frame_id == "map" and whole.width > 1000

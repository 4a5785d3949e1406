"""What the node can be asked for: parameters, the map, a new beginning, its place in a map."""

import time

import numpy as np
import pytest
import rospy
from conftest import KEEP_ALL, Peer, call, drive, play, start, stop
from geometry_msgs.msg import PoseWithCovarianceStamped
from listening import PATIENCE, diagnosed, until
from simulated_truth import MapTruth, assert_told_where_known, errors_in_map, fill_guess


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


@pytest.fixture(scope="module")
def mapped(tmp_path_factory):
    """The folder of a map that the node saved, where another drive was in it, and the bag of that drive."""
    folder = tmp_path_factory.mktemp("mapped")
    first, second = drive(folder / "first", 5, 5.0, 15.0), drive(folder / "second", 6, 7.0, 13.0)
    process = start({**KEEP_ALL, "loop_closure": True, "save_map": str(folder / "map")})
    peer = Peer()
    until(peer.connected, "all topics are there")
    play(first, 2)
    until(lambda: len(peer.heard["/tilth/odometry"]) > 90, "nearly all poses")
    saved = call("/tilth/save_map")
    assert saved.success, saved.message
    peer.close()
    stop(process)
    return folder / "map", MapTruth(folder / "map", folder / "first", folder / "second"), second


def test_it_is_found_in_a_map_that_was_saved(mapped):
    saved, truth, second = mapped
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
    errors, poses = errors_in_map(heard, truth), located.heard["/tilth/pose"]
    until(lambda: len(poses) >= len(errors), lambda: f"{len(poses)} poses in the map")
    assert_told_where_known(poses, heard)
    print(f"{len(errors)} of {len(heard)} poses in the map, {max(errors):.4f} m from the truth at most")
    assert len(errors) > len(heard) / 2 and max(errors) < 0.05
    (whole,) = located.heard["/tilth/map"]
    assert whole.header.frame_id == "map" and whole.width > 1000
    located.close()


def test_it_is_searched_for_where_it_is_said_to_be(mapped):
    saved, truth, second = mapped
    process = start({**KEEP_ALL, "map": str(saved / "places")})
    located = Peer()
    guesses = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=2)
    until(located.connected, "all topics are there")
    until(lambda: guesses.get_num_connections() > 0, "the node listens to guesses")
    guesses.publish(fill_guess(PoseWithCovarianceStamped(), truth(7.0), (0.0, 60.0)))
    guesses.publish(fill_guess(PoseWithCovarianceStamped(), truth(7.0), (0.0, 0.0), "elsewhere"))
    time.sleep(0.5)
    play(second, 1, "--duration", "3")
    heard = located.heard["/tf"]
    until(lambda: len(heard) >= 28, lambda: f"{len(heard)} transforms")
    assert not errors_in_map(heard, truth), "it is not where the guess was"
    guesses.publish(fill_guess(PoseWithCovarianceStamped(), truth(10.0), (0.6, -0.4)))
    time.sleep(0.5)
    play(second, 1, "--start", "3")
    until(lambda: len(heard) >= 56, lambda: f"{len(heard)} transforms")
    until(lambda: diagnosed(located, "place") == "located", "it says where")
    code, said = stop(process)
    errors, poses = errors_in_map(heard, truth), located.heard["/tilth/pose"]
    until(lambda: len(poses) >= len(errors), lambda: f"{len(poses)} poses in the map")
    assert_told_where_known(poses, heard)
    guesses.unregister()
    located.close()
    assert code == 0 and "about where it is said to be" in said and "'elsewhere', expected 'map'" in said
    assert len(errors) > 14 and max(errors) < 0.05

"""What the node can be asked for: parameters, the map, a new beginning; and what it does where time falls back."""

import time

import pytest
from conftest import Peer, drive, start, stop
from geometry_msgs.msg import PoseWithCovarianceStamped
from listening import PATIENCE, diagnosed, until
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.parameter import Parameter
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2
from simulated_truth import MapTruth, assert_told_where_known, errors_in_map, fill_guess, seconds
from std_srvs.srv import Trigger


def position(message):
    return message.pose.pose.position


def far(message):
    return (position(message).x ** 2 + position(message).y ** 2 + position(message).z ** 2) ** 0.5


def test_parameters_are_the_options_with_their_bounds(peer):
    process = start("map_voxel:=0.25", "queue:=7", "loop_closure:=true")
    names = peer.call(ListParameters, "/tilth/list_parameters", ListParameters.Request()).result.names
    for name in ("map_voxel", "queue", "base_from_lidar", "loop.keyframe.distance", "use_sim_time"):
        assert name in names
    wanted = ["map_voxel", "queue", "loop_closure", "map_frame"]
    values = peer.call(GetParameters, "/tilth/get_parameters", GetParameters.Request(names=wanted)).values
    assert (values[0].double_value, values[1].integer_value, values[2].bool_value) == (0.25, 7, True)
    assert values[3].string_value == "map"
    request = DescribeParameters.Request(names=wanted)
    voxel, queue, *_ = peer.call(DescribeParameters, "/tilth/describe_parameters", request).descriptors
    assert (voxel.floating_point_range[0].from_value, voxel.floating_point_range[0].to_value) == (0.001, 100.0)
    assert (queue.integer_range[0].from_value, queue.integer_range[0].to_value) == (1, 1000) and "clouds" in queue.description
    assert voxel.read_only and not queue.read_only
    assert stop(process)[0] == 0


def test_parameters_are_set_while_it_runs_or_refused(peer, recording):
    process = start("reliable:=true", "queue:=500", "map_period:=3600.0")
    scans, maps = peer.heard["/tilth/scan"], peer.heard["/tilth/map"]

    def changed(**values):
        return [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]

    def results(**values):
        request = SetParameters.Request(parameters=changed(**values))
        return peer.call(SetParameters, "/tilth/set_parameters", request).results

    def value(name):
        return peer.call(GetParameters, "/tilth/get_parameters", GetParameters.Request(names=[name])).values[0]

    peer.play(recording[1][:20], 0.05)
    until(lambda: len(scans) >= 20, "scans")
    published = len(maps)
    assert all(r.successful for r in results(scan_points=700, map_period=0.0, publish_tf=False, save_map="elsewhere"))
    peer.play(recording[1][20:40], 0.05)
    until(lambda: len(scans) >= 40 and len(maps) > published + 5, "more scans, and maps")
    assert scans[0].width > 700 and scans[-1].width == 700
    assert len(peer.heard["/tf"]) == 20 and value("save_map").string_value == "elsewhere"
    few, voxel, unknown, listed = results(scan_points=0, map_voxel=0.5, map_voxle=0.5, queue=[1, 2])
    assert not any(result.successful for result in (few, voxel, unknown, listed))
    assert "scan_points" in few.reason and "a value in" in few.reason
    assert "is read when the node starts" in voxel.reason
    assert "map_voxle" in unknown.reason and "is no value, or a list" in listed.reason
    atomic = SetParametersAtomically.Request(parameters=changed(path_poses=10, map_points=0))
    refused = peer.call(SetParametersAtomically, "/tilth/set_parameters_atomically", atomic).result
    assert not refused.successful and "map_points" in refused.reason
    assert stop(process)[0] == 0


def test_parameters_of_a_file(peer, tmp_path):
    file = tmp_path / "tilth.yaml"
    file.write_text("/**:\n  ros__parameters:\n    queue: 11\n    loop: {keyframe: {distance: 2.5}}\n"
                    "other:\n  ros__parameters:\n    queue: 12\n")
    process = start(arguments=["--params-file", str(file)])
    names = ["queue", "loop.keyframe.distance"]
    values = peer.call(GetParameters, "/tilth/get_parameters", GetParameters.Request(names=names)).values
    assert (values[0].integer_value, values[1].double_value) == (11, 2.5)
    stop(process)


def test_what_is_wrong_is_refused_with_its_name():
    for parameter, expected in (
        ("queue:=0", "queue"),
        ("map_voxle:=1.0", "map_voxle"),
        ("base_from_lidar:='1,2'", "base_from_lidar"),
        ("queue:=[1,2]", "is a list"),
    ):
        process = start(parameter)
        _, said = process.communicate(timeout=PATIENCE)
        assert process.returncode == 1 and expected in said, said


def test_the_map_is_saved_and_a_new_one_begun(peer, recording, tmp_path):
    process = start("reliable:=true", "queue:=500", "loop_closure:=true", f"save_map:={tmp_path}/map")
    nothing = peer.call(Trigger, "/tilth/save_map", Trigger.Request())
    assert not nothing.success and "no scan" in nothing.message
    peer.play(recording[1], 0.02)
    heard = peer.heard["/tilth/odometry"]
    until(lambda: len(heard) >= len(recording[1]), "all poses")
    saved = peer.call(Trigger, "/tilth/save_map", Trigger.Request())
    assert saved.success, saved.message
    assert len((tmp_path / "map/trajectory.tum").read_text().splitlines()) == len(recording[1])
    assert (tmp_path / "map/map.pcd").stat().st_size > 100_000
    assert any((tmp_path / "map/places").iterdir())
    assert far(heard[50]) > 2.0
    before = len(heard)
    assert peer.call(Trigger, "/tilth/reset", Trigger.Request()).success
    peer.play(recording[1][50:], 0.05)
    until(lambda: len(heard) > before, "it begins anew")
    assert far(heard[before]) < 0.3, "the world begins at its first scan"
    assert stop(process)[0] == 0


def test_a_recording_that_is_played_again_begins_anew(peer, recording):
    process = start("reliable:=true", "queue:=500", "use_sim_time:=true")
    clock = peer.node.create_publisher(Clock, "/clock", 1)
    until(lambda: clock.get_subscription_count() > 0, "the node listens to /clock")
    clock.publish(Clock())
    heard = peer.heard["/tilth/odometry"]
    peer.play(recording[1][:60], 0.02)
    until(lambda: len(heard) >= 60, "poses")
    peer.play(recording[1][10:60], 0.05)
    until(lambda: len(heard) > 60, "it begins anew")
    code, said = stop(process)
    assert code == 0 and "the stamps of the clouds fall back" in said
    assert far(heard[60]) < 0.3, "the world begins at its first scan"


@pytest.fixture(scope="module")
def mapped(tmp_path_factory):
    """The folder of a map that the node saved, where another drive was in it, and the clouds of that drive."""
    folder = tmp_path_factory.mktemp("mapped")
    (_, first), (_, second) = drive(folder / "first", 5, 5.0, 15.0), drive(folder / "second", 6, 7.0, 13.0)
    process = start("reliable:=true", "queue:=500", "loop_closure:=true", f"save_map:={folder}/map")
    peer = Peer(name="mapping")
    peer.play(first, 0.05)
    until(lambda: len(peer.heard["/tilth/odometry"]) >= len(first), "all poses")
    saved = peer.call(Trigger, "/tilth/save_map", Trigger.Request())
    assert saved.success, saved.message
    nowhere = peer.call(Trigger, "/tilth/localize", Trigger.Request())
    assert not nowhere.success and "no map" in nowhere.message
    peer.close()
    stop(process)
    return folder / "map", MapTruth(folder / "map", folder / "first", folder / "second"), second


def test_it_is_found_in_a_map_that_was_saved(mapped):
    folder, truth, second = mapped
    process = start("reliable:=true", "queue:=500", f"map:={folder}/places")
    located = Peer(name="located")
    heard, half = located.heard["/tf"], len(second) // 2
    located.play(second[:half], 0.05)
    until(lambda: len(heard) >= half, lambda: f"{len(heard)} transforms")
    answer = located.call(Trigger, "/tilth/localize", Trigger.Request())
    assert answer.success and "was located" in answer.message, answer.message
    located.play(second[half:], 0.05)
    until(lambda: len(heard) >= len(second), lambda: f"{len(heard)} transforms")
    errors, poses = errors_in_map(heard, truth), located.heard["/tilth/pose"]
    until(lambda: len(poses) >= len(errors), lambda: f"{len(poses)} poses in the map")
    assert stop(process)[0] == 0
    located.close()
    for begins in (0, half):
        assert [t.child_frame_id for t in heard[begins].transforms] == ["lidar"], "nothing is claimed"
    assert_told_where_known(poses, heard)
    print(f"{len(errors)} of {len(heard)} poses in the map, {max(errors):.4f} m from the truth at most")
    assert len(errors) > len(heard) / 2 and max(errors) < 0.05
    (whole,) = located.heard["/tilth/map"]
    assert whole.header.frame_id == "map" and whole.width > 1000


def test_it_is_searched_for_where_it_is_said_to_be(mapped):
    folder, truth, second = mapped
    process = start("reliable:=true", "queue:=500", f"map:={folder}/places")
    located = Peer(name="guessed")
    heard, half = located.heard["/tf"], len(second) // 2
    guesses = located.node.create_publisher(PoseWithCovarianceStamped, "/initialpose", 10)
    until(lambda: guesses.get_subscription_count() > 0, "the node listens to guesses")
    located.call(ListParameters, "/tilth/list_parameters", ListParameters.Request())  # by then it knows who guesses

    def guess(cloud, offset, frame="map"):
        stamp = seconds(deserialize_message(cloud, PointCloud2).header.stamp)
        guesses.publish(fill_guess(PoseWithCovarianceStamped(), truth(stamp), offset, frame))

    guess(second[0], (0.0, 60.0))
    guess(second[0], (0.0, 0.0), "elsewhere")
    located.play(second[:half], 0.05)
    until(lambda: len(heard) >= half, lambda: f"{len(heard)} transforms")
    assert not errors_in_map(heard, truth), "it is not where the guess was"
    guess(second[half], (0.6, -0.4))
    time.sleep(0.5)
    located.play(second[half:], 0.05)
    until(lambda: len(heard) >= len(second), lambda: f"{len(heard)} transforms")
    until(lambda: diagnosed(located, "place") == "located", "it says so")
    errors, poses = errors_in_map(heard, truth), located.heard["/tilth/pose"]
    until(lambda: len(poses) >= len(errors), lambda: f"{len(poses)} poses in the map")
    code, said = stop(process)
    located.close()
    assert_told_where_known(poses, heard)
    assert code == 0 and "about where it is said to be" in said and "'elsewhere', expected 'map'" in said
    assert len(errors) > half / 2 and max(errors) < 0.05

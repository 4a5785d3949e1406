"""What the node can be asked for: parameters, the map, a new beginning; and what it does where time falls back."""

from conftest import PATIENCE, Peer, drive, start, stop, until
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from simulated_truth import errors_in_map
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
    assert (values[0].double_value, values[1].double_value, values[2].bool_value) == (0.25, 7.0, True)
    assert values[3].string_value == "map"
    request = DescribeParameters.Request(names=wanted)
    voxel, queue, *_ = peer.call(DescribeParameters, "/tilth/describe_parameters", request).descriptors
    assert (voxel.floating_point_range[0].from_value, voxel.floating_point_range[0].to_value) == (0.001, 100.0)
    assert queue.floating_point_range[0].to_value == 1000.0 and "clouds" in queue.description and queue.read_only
    change = SetParameters.Request(parameters=[Parameter("queue", value=9.0).to_parameter_msg()])
    (result,) = peer.call(SetParameters, "/tilth/set_parameters", change).results
    assert not result.successful and "when the node starts" in result.reason
    assert stop(process)[0] == 0


def test_parameters_of_a_file(peer, tmp_path):
    file = tmp_path / "tilth.yaml"
    file.write_text("/**:\n  ros__parameters:\n    queue: 11\n    loop: {keyframe: {distance: 2.5}}\n"
                    "other:\n  ros__parameters:\n    queue: 12\n")
    process = start(arguments=["--params-file", str(file)])
    names = ["queue", "loop.keyframe.distance"]
    values = peer.call(GetParameters, "/tilth/get_parameters", GetParameters.Request(names=names)).values
    assert [value.double_value for value in values] == [11.0, 2.5]
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


def test_it_is_found_in_a_map_that_was_saved(peer, tmp_path):
    (_, first), (_, second) = drive(tmp_path / "first", 5, 5.0, 15.0), drive(tmp_path / "second", 6, 7.0, 13.0)
    process = start("reliable:=true", "queue:=500", "loop_closure:=true", f"save_map:={tmp_path}/map")
    peer.play(first, 0.05)
    until(lambda: len(peer.heard["/tilth/odometry"]) >= len(first), "all poses")
    saved = peer.call(Trigger, "/tilth/save_map", Trigger.Request())
    assert saved.success, saved.message
    nowhere = peer.call(Trigger, "/tilth/localize", Trigger.Request())
    assert not nowhere.success and "no map" in nowhere.message
    stop(process)
    process = start("reliable:=true", "queue:=500", f"map:={tmp_path}/map/places")
    located = Peer(name="located")
    heard, half = located.heard["/tf"], len(second) // 2
    located.play(second[:half], 0.05)
    until(lambda: len(heard) >= half, lambda: f"{len(heard)} transforms")
    answer = located.call(Trigger, "/tilth/localize", Trigger.Request())
    assert answer.success and "was located" in answer.message, answer.message
    located.play(second[half:], 0.05)
    until(lambda: len(heard) >= len(second), lambda: f"{len(heard)} transforms")
    assert stop(process)[0] == 0
    located.close()
    for begins in (0, half):
        assert [t.child_frame_id for t in heard[begins].transforms] == ["lidar"], "nothing is claimed"
    errors = errors_in_map(heard, tmp_path / "map", tmp_path / "first", tmp_path / "second")
    print(f"{len(errors)} of {len(heard)} poses in the map, {max(errors):.4f} m from the truth at most")
    assert len(errors) > len(heard) / 2 and max(errors) < 0.05
    (whole,) = located.heard["/tilth/map"]
    assert whole.header.frame_id == "map" and whole.width > 1000

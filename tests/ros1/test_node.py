"""What the node publishes: the poses of `tilth run` to the last bit, right frames, stamps and covariances."""

import subprocess

import pytest
import rosgraph
import rospy
from conftest import KEEP_ALL, MOUNT, Peer, launch, play, pose_numbers, start, stop, transform_numbers
from geometry_msgs.msg import TransformStamped
from listening import diagnosed, until
from mount_on_mast import mount_on_mast
from tf2_msgs.msg import TFMessage
from thinned_messages import NAMES, assert_thinned, is_last, stamp_of


def assert_same(heard, expected, frames):
    assert len(heard) == len(expected)
    for here, there in zip(heard, expected):
        assert stamp_of(here) == stamp_of(there)
        assert (here.header.frame_id, here.child_frame_id) == frames
        assert pose_numbers(here.pose.pose) == pose_numbers(there.pose.pose), "to the last bit"
        assert tuple(here.pose.covariance) == tuple(there.pose.covariance)
        assert tuple(here.twist.covariance) == tuple(there.twist.covariance)


@pytest.mark.parametrize("rate", [1, 5])
def test_poses_are_those_of_a_run(peer, sim_time, recording, run, rate):
    process = start(KEEP_ALL)
    until(peer.connected, "all topics are there")
    play(recording, rate)
    expected, heard = run[""], peer.heard["/tilth/odometry"]
    until(lambda: len(heard) >= len(expected), lambda: f"{len(heard)} poses")
    until(lambda: diagnosed(peer, "clouds_received") == str(len(expected)), "diagnostics of the last")
    assert diagnosed(peer, "clouds_dropped") == "0"
    assert stop(process)[0] == 0
    assert_same(heard, expected, ("odom", "lidar"))
    assert heard[-1].pose.pose.position.x > 5.0, "the drive leads on"


def test_frames_of_a_robot(peer, recording, run):
    process = start({**KEEP_ALL, "base_from_lidar": MOUNT, "base_frame": "base_footprint"})
    until(peer.connected, "all topics are there")
    play(recording, 5)
    expected = run[MOUNT]
    until(lambda: len(peer.heard["/tf"]) >= len(expected), "a transform with every pose")
    late = Peer(["/tf_static", "/tilth/map"])
    until(lambda: late.heard["/tf_static"] and late.heard["/tilth/map"], "who comes late hears what is latched")
    late.close()
    stop(process)
    assert_same(peer.heard["/tilth/odometry"], expected, ("odom", "base_footprint"))
    for message, there in zip(peer.heard["/tf"], expected):
        corrected, way = message.transforms
        assert (corrected.header.frame_id, corrected.child_frame_id) == ("map", "odom")
        assert (way.header.frame_id, way.child_frame_id) == ("odom", "base_footprint")
        assert stamp_of(corrected) == stamp_of(way) == stamp_of(there)
        assert transform_numbers(way.transform) == pose_numbers(there.pose.pose)
        assert corrected.transform.rotation.w == 1.0, "no loop is closed"
    (mount,) = peer.heard["/tf_static"][-1].transforms
    assert (mount.header.frame_id, mount.child_frame_id) == ("base_footprint", "lidar")
    assert abs(mount.transform.translation.z - 0.7) < 1e-12


def test_mount_of_a_robot_description(peer, recording, run):
    process = start({**KEEP_ALL, "mount_from_tf": True})
    description = rospy.Publisher("/tf_static", TFMessage, latch=True, queue_size=1)
    description.publish(TFMessage(mount_on_mast(TransformStamped, MOUNT)))
    until(peer.connected, "all topics are there")
    play(recording, 5)
    heard, expected = peer.heard["/tilth/odometry"], run[MOUNT]
    until(lambda: len(heard) >= len(expected), lambda: f"{len(heard)} poses")
    assert stop(process)[0] == 0
    description.unregister()
    assert heard[-1].child_frame_id == "base_link"
    for here, there in zip(heard, expected):
        assert pose_numbers(here.pose.pose) == pytest.approx(pose_numbers(there.pose.pose), abs=1e-6)


def test_scan_map_path_and_diagnostics(peer, recording, run):
    process = start({**KEEP_ALL, "scan_points": 3000, "map_points": 9000})
    until(peer.connected, "all topics are there")
    play(recording, 5)
    last = run[""][-1]
    for name in NAMES:
        until(lambda: is_last(name, peer.heard[f"/tilth/{name}"], last), f"the last {name}")
    until(lambda: diagnosed(peer, "clouds_received") == str(len(run[""])), "diagnostics of the last")
    stop(process)
    scan, whole, way = (peer.heard[f"/tilth/{name}"][-1] for name in ("scan", "map", "path"))
    assert_thinned(scan, whole, way)
    assert len(way.poses) == len(run[""])
    for here, there in zip(way.poses, run[""]):
        assert pose_numbers(here.pose) == pose_numbers(there.pose.pose) and stamp_of(here) == stamp_of(there)
    (status,) = peer.heard["/diagnostics"][-1].status
    assert (status.name, status.message, status.level) == ("tilth: track", "tracking", 0)


def test_clouds_that_make_way_are_counted_and_said(peer, recording):
    process = start({"queue": 1})
    until(peer.connected, "all topics are there")
    play(recording, 20)
    until(lambda: peer.heard["/diagnostics"], "it begins")
    until(lambda: int(diagnosed(peer, "clouds_dropped")) > 0, "drops are said")
    code, said = stop(process)
    assert code == 0 and "this computer is too slow" in said
    assert max(message.status[0].level for message in peer.heard["/diagnostics"]) >= 1
    assert int(diagnosed(peer, "clouds_received")) > len(peer.heard["/tilth/odometry"])


@pytest.mark.parametrize("manager", ["", "robot"])
def test_launch_file_and_nodelet(peer, recording, run, manager):
    if rospy.has_param("/tilth"):
        rospy.delete_param("/tilth")
    rospy.set_param("/tilth/queue", 500)
    if manager:
        launch(["/usr/lib/nodelet/nodelet", "manager", f"__name:={manager}"], subprocess.DEVNULL)
    arguments = ["points:=/velodyne_points", f"base_from_lidar:={MOUNT}", f"manager:={manager}"]
    launch(["roslaunch", "tilth_ros1", "tilth.launch", *arguments], subprocess.DEVNULL)
    until(peer.connected, "all topics are there")
    play(recording, 5, "/points:=/velodyne_points")
    heard = peer.heard["/tilth/odometry"]
    until(lambda: len(heard) >= len(run[MOUNT]), lambda: f"{len(heard)} poses")
    assert_same(heard, run[MOUNT], ("odom", "base_link"))
    publishers = dict(rosgraph.Master("/peer").getSystemState()[0])
    assert publishers["/tilth/odometry"] == ["/robot" if manager else "/tilth"]

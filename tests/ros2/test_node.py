"""What the node publishes: the poses of `tilth run` to the last bit, right frames, stamps, types and QoS."""

import time

import pytest
from conftest import LATCHED, MOUNT, Peer, start, stop
from geometry_msgs.msg import TransformStamped
from listening import diagnosed, until
from mount_on_mast import mount_on_mast
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from tf2_msgs.msg import TFMessage
from thinned_messages import NAMES, assert_thinned, is_last, stamp_of

KEEP_ALL = ("reliable:=true", "queue:=500", "map_period:=0.0")


@pytest.mark.parametrize("rate", [1, 5])
def test_poses_are_those_of_a_run(peer, recording, run, rate):
    process = start(*KEEP_ALL)
    peer.play(recording[1], 0.1 / rate)
    expected, heard = run[""], peer.heard["/tilth/odometry"]
    until(lambda: len(heard) >= len(expected), lambda: f"{len(heard)} poses; {peer.heard['/diagnostics'][-1]}")
    assert stop(process)[0] == 0
    assert len(heard) == len(expected)
    assert diagnosed(peer, "clouds_dropped") == "0"
    for here, there in zip(heard, expected):
        assert stamp_of(here) == stamp_of(there)
        assert (here.header.frame_id, here.child_frame_id) == ("odom", "lidar")
        assert here.pose.pose == there.pose.pose, "to the last bit"
        assert list(here.pose.covariance) == list(there.pose.covariance)
        assert here.twist == there.twist
    assert heard[-1].pose.pose.position.x > 5.0, "the drive leads on"


def test_frames_of_a_robot(peer, recording, run):
    process = start(*KEEP_ALL, f"base_from_lidar:='{MOUNT}'", "base_frame:=base_footprint")
    peer.play(recording[1], 0.02)
    expected = run[MOUNT]
    until(lambda: len(peer.heard["/tf"]) >= len(expected), "a transform with every pose")
    late = Peer(["/tf_static", "/tilth/map"], "late")
    until(lambda: late.heard["/tf_static"] and late.heard["/tilth/map"], "who comes late hears what is latched")
    late.close()
    stop(process)
    for message, there in zip(peer.heard["/tf"], expected):
        corrected, way = message.transforms
        assert (corrected.header.frame_id, corrected.child_frame_id) == ("map", "odom")
        assert (way.header.frame_id, way.child_frame_id) == ("odom", "base_footprint")
        assert stamp_of(corrected) == stamp_of(way) == stamp_of(there)
        for axis in "xyz":
            assert getattr(way.transform.translation, axis) == getattr(there.pose.pose.position, axis)
        assert way.transform.rotation == there.pose.pose.orientation
        assert corrected.transform.rotation.w == 1.0, "no loop is closed"
    for here, there in zip(peer.heard["/tilth/odometry"], expected):
        assert here.child_frame_id == "base_footprint"
        assert list(here.pose.covariance) == list(there.pose.covariance)
    (mount,) = peer.heard["/tf_static"][-1].transforms
    assert (mount.header.frame_id, mount.child_frame_id) == ("base_footprint", "lidar")
    assert abs(mount.transform.translation.z - 0.7) < 1e-12


def test_mount_of_a_robot_description(peer, recording, run):
    description = peer.node.create_publisher(TFMessage, "/tf_static", LATCHED)
    description.publish(TFMessage(transforms=mount_on_mast(TransformStamped, MOUNT)))
    process = start(*KEEP_ALL, "mount_from_tf:=true")
    peer.play(recording[1], 0.02)
    heard, expected = peer.heard["/tilth/odometry"], run[MOUNT]
    until(lambda: len(heard) >= len(expected), lambda: f"{len(heard)} poses")
    assert stop(process)[0] == 0
    peer.node.destroy_publisher(description)
    assert heard[-1].child_frame_id == "base_link"
    for here, there in zip(heard, expected):
        for axis in "xyz":
            assert abs(getattr(here.pose.pose.position, axis) - getattr(there.pose.pose.position, axis)) < 1e-6


def test_scan_map_path_and_diagnostics(peer, recording, run):
    process = start(*KEEP_ALL, "scan_points:=3000", "map_points:=9000")
    peer.play(recording[1][:40], 0.02)
    last = run[""][39]
    for name in NAMES:
        until(lambda: is_last(name, peer.heard[f"/tilth/{name}"], last), f"the last {name}")
    stop(process)
    scan, whole, way = (peer.heard[f"/tilth/{name}"][-1] for name in ("scan", "map", "path"))
    assert_thinned(scan, whole, way)
    assert len(way.poses) == 40
    for here, there in zip(way.poses, run[""]):
        assert here.pose == there.pose.pose and stamp_of(here) == stamp_of(there)
    (status,) = peer.heard["/diagnostics"][-1].status
    assert (status.name, status.message, status.level) == ("tilth: track", "tracking", b"\x00")
    assert diagnosed(peer, "clouds_received") == "40"


def test_qualities_of_service_and_types(peer):
    process = start()
    until(lambda: peer.clouds.get_subscription_count() > 0, "the node listens")
    (points,) = peer.node.get_subscriptions_info_by_topic("/clouds")
    assert points.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT, "sensor data"
    own = peer.node.get_publishers_info_by_topic("/clouds")[0]
    assert points.topic_type_hash == own.topic_type_hash
    for topic, latched in (("/tilth/map", True), ("/tf_static", True), ("/tf", False), ("/tilth/odometry", False)):
        until(lambda: peer.node.get_publishers_info_by_topic(topic), topic)
        (published,) = peer.node.get_publishers_info_by_topic(topic)
        (listening,) = peer.node.get_subscriptions_info_by_topic(topic)
        assert published.qos_profile.reliability == ReliabilityPolicy.RELIABLE
        durable = published.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
        assert durable == latched, topic
        assert published.topic_type == listening.topic_type
        assert published.topic_type_hash == listening.topic_type_hash
    assert stop(process)[0] == 0


def test_what_sensor_data_quality_loses_is_counted(peer, recording):
    process = start("queue:=100")
    clouds, heard = recording[1], peer.heard["/diagnostics"]
    peer.play(clouds, 0.05)
    sent = len(clouds)
    while not heard and sent < 1000:  # eight must arrive before it begins
        peer.clouds.publish(clouds[-1])
        sent += 1
        time.sleep(0.05)
    time.sleep(1.0)
    received, lost = int(diagnosed(peer, "clouds_received")), int(diagnosed(peer, "clouds_lost"))
    code, said = stop(process)
    print(f"{received} clouds received, {lost} lost, {sent} sent")
    assert code == 0 and received >= 8
    assert sent // 2 < received + lost <= sent
    assert (lost > 0) == ("lost on the way" in said)


def test_clouds_that_make_way_are_counted_and_said(peer, recording):
    process = start("reliable:=true", "queue:=1")
    peer.play(recording[1] * 2, 0.002)
    until(lambda: peer.heard["/diagnostics"], "it begins")
    until(lambda: int(diagnosed(peer, "clouds_dropped")) > 0, "drops are said")
    code, said = stop(process)
    assert code == 0 and "this computer is too slow" in said
    assert max(message.status[0].level for message in peer.heard["/diagnostics"]) >= b"\x01"
    assert int(diagnosed(peer, "clouds_received")) > len(peer.heard["/tilth/odometry"])

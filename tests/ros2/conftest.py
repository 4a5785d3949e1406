"""The node as a program of its own, a recording to play to it, and a listener that keeps what it hears."""

import os
import signal
import subprocess
import threading
import time
from collections import defaultdict
from pathlib import Path

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from listening import PATIENCE, until
from mcap.reader import make_reader
from nav_msgs.msg import Odometry, Path as Way
from rcl_interfaces.srv import ListParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import PointCloud2, PointField
from tf2_msgs.msg import TFMessage

PROGRAM, NODE = os.environ["TILTH_PROGRAM"], os.environ["TILTH_ROS2_NODE"]
RUNNING = []  # programs of this test
RELIABLE = QoSProfile(depth=500, reliability=ReliabilityPolicy.RELIABLE)
LATCHED = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TYPES = {
    "/tilth/odometry": (Odometry, RELIABLE),
    "/tilth/path": (Way, RELIABLE),
    "/tilth/scan": (PointCloud2, RELIABLE),
    "/tilth/map": (PointCloud2, LATCHED),
    "/tf": (TFMessage, RELIABLE),
    "/tf_static": (TFMessage, LATCHED),
    "/tilth/pose": (PoseWithCovarianceStamped, RELIABLE),
    "/diagnostics": (DiagnosticArray, RELIABLE),
}
MOUNT = "0.3,0.1,0.7,2,-3,20"


class Peer:
    """A node of rclpy that spins in a thread of its own: hears the topics it is given, and plays clouds."""

    def __init__(self, topics=tuple(TYPES), name="peer"):
        self.node = rclpy.create_node(name)
        self.heard = defaultdict(list)
        for topic in topics:
            kind, qos = TYPES[topic]
            self.node.create_subscription(kind, topic, self.heard[topic].append, qos)
        self.clouds = self.node.create_publisher(PointCloud2, "/clouds", RELIABLE)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self.executor.spin, daemon=True)
        self.thread.start()

    def play(self, clouds, step):
        """One cloud every `step` seconds, once somebody listens."""
        until(lambda: self.clouds.get_subscription_count() > 0, "the node listens to clouds")
        for topic in self.heard:
            until(lambda: self.node.count_publishers(topic) > 0, f"the node publishes {topic}")
        # Who made a client later than all else is answered by a node that knows all else by then.
        self.call(ListParameters, "/tilth/list_parameters", ListParameters.Request())
        self.send(clouds, step)

    def send(self, clouds, step):
        """One cloud every `step` seconds."""
        due = time.monotonic()
        for cloud in clouds:
            self.clouds.publish(cloud)
            due += step
            time.sleep(max(0.0, due - time.monotonic()))

    def call(self, kind, name, request):
        client = self.node.create_client(kind, name)
        assert client.wait_for_service(PATIENCE), name
        answer = client.call_async(request)
        until(answer.done, f"{name} answers")
        self.node.destroy_client(client)
        return answer.result()

    def close(self):
        self.executor.shutdown()
        self.thread.join()
        self.node.destroy_node()


def start(*parameters, arguments=()):
    """The node, with `parameters` as name:=value."""
    command = [NODE, "--ros-args", "-r", "points:=/clouds", *arguments]
    for parameter in parameters:
        command += ["-p", parameter]
    return launch(command, stderr=subprocess.PIPE)


def launch(command, **how):
    """A program; how it is begun is as for Popen."""
    environment = dict(os.environ, LD_PRELOAD=os.environ["TILTH_ROS2_PRELOAD"])
    RUNNING.append(subprocess.Popen(command, **{"env": environment, "text": True, **how}))
    return RUNNING[-1]


def stop(process):
    """Its exit code and what it said, after the interrupt that is its ordinary end."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE)
    return process.returncode, said


@pytest.fixture(autouse=True)
def leave_nothing():
    """A test that fails leaves no program behind for the next one to talk to."""
    yield
    while RUNNING:
        RUNNING.pop().kill()


@pytest.fixture(scope="session", autouse=True)
def ros():
    rclpy.init()
    yield
    rclpy.shutdown()


@pytest.fixture
def peer():
    made = Peer()
    yield made
    made.close()


def as_ros2(cloud):
    """A message of ROS 1 as one of ROS 2."""
    message = PointCloud2(height=cloud.height, width=cloud.width, point_step=cloud.point_step, row_step=cloud.row_step)
    message.header.frame_id = cloud.header.frame_id
    message.header.stamp.sec, message.header.stamp.nanosec = cloud.header.stamp.sec, cloud.header.stamp.nanosec
    for f in cloud.fields:
        message.fields.append(PointField(name=f.name, offset=f.offset, datatype=f.datatype, count=f.count))
    message.is_bigendian, message.is_dense = bool(cloud.is_bigendian), bool(cloud.is_dense)
    message.data = cloud.data.tobytes()
    return message


def drive(folder, seed, begin, end):
    """Seconds `begin` to `end` of a drive along the corridor, about 1 m/s, as a ROS 2 bag in MCAP, and its messages;
    truth.tum lies beside it."""
    scene = ["corridor", "--duration", str(end), "--set", "speed=2", "world_seed=1", "--seed", str(seed)]
    subprocess.run([PROGRAM, "simulate", *scene, "--out", folder, "--format", "bag", "--quiet"], check=True)
    store = get_typestore(Stores.ROS2_JAZZY)
    clouds = []
    mcap = Writer(folder / "mcap", version=9, storage_plugin=StoragePlugin.MCAP)
    with AnyReader([folder / "scans.bag"]) as bag, mcap as out:
        connection = out.add_connection("/clouds", "sensor_msgs/msg/PointCloud2", typestore=store)
        for source, stamp, raw in bag.messages():
            if stamp < begin * 1e9:
                continue
            clouds.append(serialize_message(as_ros2(bag.deserialize(raw, source.msgtype))))
            out.write(connection, stamp, clouds[-1])
    return folder / "mcap", clouds


@pytest.fixture(scope="session")
def recording(tmp_path_factory):
    """Ten seconds; before, it stands still."""
    return drive(tmp_path_factory.mktemp("corridor"), 1, 5.0, 15.0)


def odometry_of(folder):
    """What `tilth run --mcap` and `tilth live --mcap` write of it."""
    with open(Path(folder) / "run.mcap", "rb") as file:
        messages = make_reader(file).iter_messages(topics=["/odometry"])
        return [deserialize_message(message.data, Odometry) for _, _, message in messages]


@pytest.fixture(scope="session")
def run(recording, tmp_path_factory):
    """What `tilth run` makes of the recording, without and with a mount: odometry by its stamp."""

    def odometry(*arguments):
        out = tmp_path_factory.mktemp("run")
        subprocess.run([PROGRAM, "run", recording[0], "--out", out, "--mcap", "--quiet", *arguments], check=True)
        return odometry_of(out)

    return {"": odometry(), MOUNT: odometry("--base-from-lidar", MOUNT)}

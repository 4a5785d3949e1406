"""A roscore, the node as a program of its own, recordings to play to it, and a listener that keeps what it hears."""

import os
import signal
import socket
import subprocess
from collections import defaultdict
from pathlib import Path

import pytest
import rosbag
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from listening import PATIENCE, until
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from nav_msgs.msg import Odometry, Path as Way
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

PROGRAM, NODE = os.environ["TILTH_PROGRAM"], os.environ["TILTH_ROS1_NODE"]
RUNNING = []  # programs of this test
TYPES = {
    "/tilth/odometry": Odometry,
    "/tilth/path": Way,
    "/tilth/scan": PointCloud2,
    "/tilth/map": PointCloud2,
    "/tf": TFMessage,
    "/tf_static": TFMessage,
    "/tilth/pose": PoseWithCovarianceStamped,
    "/diagnostics": DiagnosticArray,
}
MOUNT = "0.3,0.1,0.7,2,-3,20"
KEEP_ALL = {"queue": 500, "map_period": 0.0}


class Peer:
    """Hears the topics it is given."""

    def __init__(self, topics=tuple(TYPES)):
        self.heard = defaultdict(list)
        self.subscribers = [rospy.Subscriber(t, TYPES[t], self.heard[t].append, queue_size=2000) for t in topics]

    def connected(self):
        """To every topic of the node."""
        return all(subscriber.get_num_connections() > 0 for subscriber in self.subscribers)

    def close(self):
        for subscriber in self.subscribers:
            subscriber.unregister()


def call(service):
    rospy.wait_for_service(service, PATIENCE)
    return rospy.ServiceProxy(service, Trigger)()


def launch(command, said=subprocess.PIPE):
    """A program; what it says is for stop() to read, or goes where `said` tells."""
    RUNNING.append(subprocess.Popen(command, stderr=said, stdout=said, text=True))
    return RUNNING[-1]


def start(parameters):
    """The node, with `parameters` under its name, and no others."""
    if rospy.has_param("/tilth"):
        rospy.delete_param("/tilth")
    for name, value in parameters.items():
        rospy.set_param("/tilth/" + name, value)
    return launch([NODE])


def stop(process):
    """Its exit code and what it said, after the interrupt that is its ordinary end."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    out, said = process.communicate(timeout=PATIENCE)
    return process.returncode, out + said


def play(bag, rate, *arguments):
    """All of the bag, once somebody listens; with the time that it was recorded at."""
    options = ["--clock", "--quiet", "--wait-for-subscribers", "--rate", str(rate)]
    subprocess.run(["rosbag", "play", *options, *arguments, str(bag)], check=True, stdout=subprocess.DEVNULL)


@pytest.fixture(autouse=True)
def leave_nothing():
    """A test that fails leaves no node behind for the next one to talk to."""
    yield
    while RUNNING:
        process = RUNNING.pop()
        process.send_signal(signal.SIGINT)  # roslaunch ends what it began
        try:
            process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()


@pytest.fixture(scope="session", autouse=True)
def ros():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    core = subprocess.Popen(["roscore", "-p", str(port)], stdout=subprocess.DEVNULL)
    until(rosgraph.is_master_online, "the master is there")
    rospy.init_node("peer", disable_signals=True)
    yield
    rospy.signal_shutdown("the end")
    core.send_signal(signal.SIGINT)
    core.wait(PATIENCE)


@pytest.fixture
def peer():
    made = Peer()
    yield made
    made.close()


@pytest.fixture
def sim_time():
    """Nodes that begin now take their time from /clock."""
    rospy.set_param("/use_sim_time", True)
    yield
    rospy.delete_param("/use_sim_time")


def drive(folder, seed, begin, end):
    """Seconds `begin` to `end` of a drive along the corridor, about 1 m/s, as a bag; truth.tum lies beside it."""
    scene = ["corridor", "--duration", str(end), "--set", "speed=2", "world_seed=7", "--seed", str(seed)]
    subprocess.run([PROGRAM, "simulate", *scene, "--out", folder, "--format", "bag", "--quiet"], check=True)
    with rosbag.Bag(str(folder / "scans.bag")) as whole, rosbag.Bag(str(folder / "drive.bag"), "w") as bag:
        for topic, message, stamp in whole.read_messages(raw=True):
            if stamp.to_sec() > begin:
                bag.write(topic, message, stamp, raw=True)
    return folder / "drive.bag"


@pytest.fixture(scope="session")
def recording(tmp_path_factory):
    """Ten seconds; before, it stands still."""
    return drive(tmp_path_factory.mktemp("corridor"), 5, 5.0, 15.0)


@pytest.fixture(scope="session")
def run(recording, tmp_path_factory):
    """What `tilth run` makes of the recording, without and with a mount: odometry by its stamp."""

    def odometry(*arguments):
        out = tmp_path_factory.mktemp("run")
        subprocess.run([PROGRAM, "run", recording, "--out", out, "--mcap", "--quiet", *arguments], check=True)
        with open(Path(out) / "run.mcap", "rb") as file:
            reader = make_reader(file, decoder_factories=[DecoderFactory()])
            return [message for *_, message in reader.iter_decoded_messages(topics=["/odometry"])]

    return {"": odometry(), MOUNT: odometry("--base-from-lidar", MOUNT)}


def pose_numbers(pose):
    p, q = pose.position, pose.orientation
    return p.x, p.y, p.z, q.x, q.y, q.z, q.w


def transform_numbers(transform):
    p, q = transform.translation, transform.rotation
    return p.x, p.y, p.z, q.x, q.y, q.z, q.w

"""`tilth live ros2:TOPIC`: the poses of `tilth run` to the last bit, and what it says where nothing comes."""

import os
import subprocess

from conftest import PROGRAM, NODE, launch, odometry_of, stop
from listening import PATIENCE, until
from tf2_msgs.msg import TFMessage

LIBRARY = os.path.join(os.path.dirname(NODE), "libtilth_ros2.so")


def live(topic, out, *arguments):
    """The program, and the file that it talks into."""
    said = out.with_suffix(".txt")
    command = [PROGRAM, "live", f"ros2:{topic}", "--out", out, "--library", LIBRARY, *arguments]
    with open(said, "w") as file:
        return launch(command, stdout=file, stderr=subprocess.STDOUT), said


def until_said(sentence, said):
    until(lambda: sentence in said.read_text(), lambda: f"'{sentence}' in: {said.read_text()}")


def test_poses_are_those_of_a_run(peer, recording, run, tmp_path):
    options = ["--reliable", "--queue", "500", "--idle", "8", "--mcap"]
    process, said = live("/clouds", tmp_path / "out", *options)
    until_said("waits for clouds of /clouds: who sends it is silent", said)
    peer.send(recording[1], 0.05)
    assert process.wait(PATIENCE) == 0, said.read_text()
    assert " lost on the way" not in said.read_text() and " dropped" not in said.read_text()
    here, there = odometry_of(tmp_path / "out"), run[""]
    assert len(here) == len(there)
    for one, other in zip(here, there):
        assert one.header.stamp == other.header.stamp
        assert one.pose.pose == other.pose.pose, "to the last bit"
        assert list(one.pose.covariance) == list(other.pose.covariance)
    assert len((tmp_path / "out/trajectory.tum").read_text().splitlines()) == len(there)
    assert "ros2:/clouds" in (tmp_path / "out/summary.json").read_text()


def test_what_makes_way_is_counted_and_said(peer, recording, tmp_path):
    process, said = live("/clouds?reliable=true&queue=1&idle=8", tmp_path / "out")
    until_said("who sends it is silent", said)
    peer.send(recording[1], 0.02)
    assert process.wait(PATIENCE) in (0, 3), "the track may get lost: " + said.read_text()
    assert "this computer is too slow" in said.read_text()
    assert "this computer is too slow" in (tmp_path / "out/summary.json").read_text(), "its last word"
    assert 8 <= len((tmp_path / "out/trajectory.tum").read_text().splitlines()) < len(recording[1])


def test_what_never_comes_is_waited_for_in_words(peer, tmp_path):
    process, said = live("/nowhere", tmp_path / "nowhere")
    other = peer.node.create_publisher(TFMessage, "/transforms", 1)
    wrong, said_wrong = live("/transforms", tmp_path / "wrong", "--duration", "8")
    until_said("waits for clouds of /nowhere: nobody sends it", said)
    until_said("peer sends tf2_msgs/msg/TFMessage, expected sensor_msgs/msg/PointCloud2", said_wrong)
    assert stop(process)[0] == 130, "128 and the number of the interrupt"
    assert wrong.wait(PATIENCE) == 1 and "no cloud came: peer sends" in said_wrong.read_text()
    peer.node.destroy_publisher(other)


def test_without_the_library_or_ros_it_is_refused(tmp_path):
    def refusal(*arguments, **environment):
        command = [PROGRAM, "live", "ros2:/clouds", "--out", tmp_path / "out", *arguments]
        done = subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True, timeout=PATIENCE)
        assert done.returncode == 1
        return done.stderr

    assert "libtilth_ros2.so: is not found" in refusal()
    assert "cannot be loaded" in refusal("--library", LIBRARY, LD_LIBRARY_PATH="")
    folder = os.path.dirname(LIBRARY)
    assert "cannot be loaded" in refusal(LD_LIBRARY_PATH=folder), "found, but it lacks ROS 2"
    assert "no topic" in subprocess.run(
        [PROGRAM, "live", "ros2:", "--out", tmp_path / "out"], capture_output=True, text=True, timeout=PATIENCE
    ).stderr

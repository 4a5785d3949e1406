"""A run that is watched over a WebSocket (PyPI's websockets), its messages decoded by rosbags: poses to the last bit those
of trajectory.tum; a client that does not read for ten seconds costs the run nothing. Argument: the program tilth."""

import asyncio
import base64
import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

numpy, websockets, rosbags = needs("numpy", "websockets", "rosbags")
from rosbags.typesys import Stores, get_typestore  # noqa: E402
from websockets.asyncio.client import connect  # noqa: E402

TILTH = sys.argv[1]
SCENE = "sim://plaza?seed=9&duration={}"
STORE = get_typestore(Stores.ROS2_HUMBLE)
HEAD = struct.Struct("<BIQ")
STALL = 10.0  # [s]


def watched(*command):
    """The program with --view, and its port."""
    run = subprocess.Popen([TILTH, *map(str, command), "--view", "0"], stdout=subprocess.PIPE, text=True)
    for line in run.stdout:
        if found := re.search(r"ws://127\.0\.0\.1:(\d+)", line):
            return run, int(found[1])
    raise AssertionError("the run says no address")


def started(out, seconds, *more):
    return watched("run", SCENE.format(seconds), "--out", out, *more)


def poses_of(out):
    return numpy.loadtxt(out / "trajectory.tum", ndmin=2)


async def followed(port):
    """Every message until the run ends: topic, stamp [ns], decoded."""
    messages, channels = [], {}
    async with connect(f"ws://127.0.0.1:{port}", subprotocols=["foxglove.sdk.v1"], max_size=None) as client:
        assert client.subprotocol == "foxglove.sdk.v1"
        await client.send("this is no JSON")
        try:
            async for data in client:
                if isinstance(data, bytes):
                    opcode, subscription, stamp = HEAD.unpack_from(data)
                    channel = channels[subscription]
                    assert opcode == 1
                    messages.append((channel["topic"], stamp, STORE.deserialize_cdr(data[HEAD.size:], channel["schemaName"])))
                    continue
                said = json.loads(data)
                if said["op"] == "advertise":
                    channels = {10 + c["id"]: c for c in said["channels"]}
                    await client.send(json.dumps({"op": "subscribe", "subscriptions": [
                        {"id": id, "channelId": c["id"]} for id, c in channels.items()]}))
                elif said["op"] == "status":
                    assert said["level"] == 2 and "no object in JSON" in said["message"], said
        except websockets.exceptions.ConnectionClosed:
            pass
    return messages


def check_odometry(messages, poses):
    by_stamp = {round(row[0] * 1e9): row for row in poses}
    assert len(messages) > len(poses) - 30
    for stamp, odometry in messages:
        row = by_stamp[min(by_stamp, key=lambda t: abs(t - stamp))]
        assert abs(row[0] * 1e9 - stamp) < 1000
        position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        assert (odometry.header.frame_id, odometry.child_frame_id) == ("world", "base_link")
        assert [position.x, position.y, position.z] == list(row[1:4]), "to the last bit"
        assert numpy.abs(numpy.abs([q.x, q.y, q.z, q.w]) - numpy.abs(row[4:])).max() < 1e-12


def check_messages(folder):
    run, port = started(folder / "seen", 6, "--base-from-lidar", "0.2,0,0.5,0,5,0")
    messages = asyncio.run(followed(port))
    assert run.wait() == 0
    poses = poses_of(folder / "seen")
    topics = {topic: [(t, m) for name, t, m in messages if name == topic] for topic, *_ in messages}
    assert set(topics) == {"/path", "/map", "/tf", "/odometry", "/scan", "/diagnostics"}
    check_odometry(topics["/odometry"], poses)
    _, path = topics["/path"][-1]
    assert [p.pose.position.x for p in path.poses] == list(poses[:, 1]), "the last path is the whole"
    _, last = topics["/map"][-1]
    assert last.header.frame_id == "world" and 1000 < last.width <= 100_000
    assert last.data.size == last.width * last.point_step
    assert all(scan.header.frame_id == "lidar" and scan.width > 1000 for _, scan in topics["/scan"])
    assert all(len(tf.transforms) == 2 for _, tf in topics["/tf"])
    assert {m.status[0].values[0].value for _, m in topics["/diagnostics"]} == {"tracking"}


def check_frames(messages, poses):
    """While loops are being closed poses are given in odom, which lies in the world; in the end all lies there."""
    chains = {tuple((t.header.frame_id, t.child_frame_id) for t in m.transforms) for topic, _, m in messages if topic == "/tf"}
    assert chains == {(("world", "odom"), ("odom", "lidar"))}, chains
    assert {m.header.frame_id for topic, _, m in messages if topic == "/odometry"} == {"odom"}
    for name in ("/path", "/map"):
        frames = [m.header.frame_id for topic, _, m in messages if topic == name]
        assert set(frames[:-1]) <= {"odom"} and frames[-1] == "world", (name, frames)
    last = [m for topic, _, m in messages if topic == "/path"][-1]
    assert [p.pose.position.x for p in last.poses] == list(poses[:, 1]), "the last path is the corrected one"


def check_live(folder):
    """The same of a sensor that sends: `tilth play` is it."""
    recording = folder / "recording"
    subprocess.run([TILTH, "simulate", "plaza", "--sensor", "vlp16", "--format", "pcap", "--duration", "8", "--out", recording],
                   check=True, stdout=subprocess.DEVNULL)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        packets = f"127.0.0.1:{free.getsockname()[1]}"
    run, port = watched("live", f"udp://{packets}", "--out", folder / "live", "--idle", "3", "--level", "--queue", "100",
                        "--loop-closure")
    assert "listening" in run.stdout.readline()
    player = subprocess.Popen([TILTH, "play", recording / "scans.pcap", "--to", packets], stdout=subprocess.DEVNULL)
    messages = asyncio.run(followed(port))
    run.stdout.read()
    assert run.wait() == 0 and player.wait() == 0
    poses = numpy.loadtxt(folder / "live" / "trajectory_odometry.tum", ndmin=2)
    check_frames(messages, poses_of(folder / "live"))
    odometry = [m for topic, _, m in messages if topic == "/odometry"]
    assert len(poses) > 60 and len(poses) - 30 < len(odometry) <= len(poses), (len(poses), len(odometry))
    assert odometry[-1].child_frame_id == "lidar" and abs(odometry[-1].pose.pose.position.x - poses[-1, 1]) < 1e-12
    assert "levelled_by" in json.loads((folder / "live" / "summary.json").read_text())["frames"]


def stalled_client(port):
    """Asks for everything, and then reads nothing."""
    client = socket.socket()
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 16)  # the system keeps little for it
    client.connect(("127.0.0.1", port))
    key = base64.b64encode(os.urandom(16)).decode()
    client.sendall(("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                    f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
                    "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n").encode())
    assert client.recv(12) == b"HTTP/1.1 101"
    request = json.dumps({"op": "subscribe", "subscriptions": [{"id": i, "channelId": i} for i in range(1, 7)]}).encode()
    client.sendall(bytes([0x81, 0x80 | 126]) + struct.pack(">H", len(request)) + bytes(4) + request)
    return client


def told_of_drops(client):
    """Whether the client hears, when it reads again, that something was left out."""
    client.settimeout(60)
    tail = b""
    while part := client.recv(1 << 20):
        tail = tail[-1000:] + part
        if b"left out" in tail:
            return True
    return False


def cpu_ms(out):
    table = numpy.genfromtxt(out / "scans.csv", delimiter=",", names=True)
    return numpy.median(table["cpu_ms_register"])


def check_stalled(folder):
    """Of the same recording; the time is that of the registering thread, since other programs share the processors."""
    for name in ("alone", "stalled"):
        run, port = started(folder / name, 60, "--threads", "1")
        if name == "stalled":
            client = stalled_client(port)
            time.sleep(STALL)
            assert run.poll() is None, "the run was over before: too short for this test"
            assert told_of_drops(client)
            client.close()
        run.stdout.read()
        assert run.wait() == 0
    assert (folder / "alone" / "trajectory.tum").read_bytes() == (folder / "stalled" / "trajectory.tum").read_bytes()
    alone, stalled = cpu_ms(folder / "alone"), cpu_ms(folder / "stalled")
    print(f"a scan, median of CPU: {alone:.2f} ms alone, {stalled:.2f} ms with a client that does not read")
    assert stalled < 1.3 * alone + 0.5


with tempfile.TemporaryDirectory() as temporary:
    check_messages(pathlib.Path(temporary))
    check_live(pathlib.Path(temporary))
    check_stalled(pathlib.Path(temporary))
print("a run can be watched, and is not disturbed")

"""ROS 1 bags against the package rosbags, both ways, bit for bit. Arguments: the program format_probe."""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

numpy, rosbags = needs("numpy", "rosbags")
from rosbags.rosbag1 import Reader, Writer  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402

PROBE = sys.argv[1]
BEGIN = 1_600_000_000_000_000_123  # ns
CLOUD, TEXT = "sensor_msgs/msg/PointCloud2", "std_msgs/msg/String"


def some_messages(count):
    """(topic, ns, bytes): clouds, and small messages half a second late, so that chunks overlap in time."""
    random = numpy.random.default_rng(1)
    messages = []
    for i in range(count):
        stamp = BEGIN + i * 100_000_000
        messages.append(("/points", stamp, random.integers(0, 9, 50_000, dtype="u1").tobytes()))
        messages.append(("/log", stamp - 500_000_000, random.integers(0, 256, 11, dtype="u1").tobytes()))
    return messages


def write_bag(path, messages, compression):
    store = get_typestore(Stores.ROS1_NOETIC)
    bag = Writer(path)
    if compression:
        bag.set_compression(compression)
    with bag as writer:
        connections = {
            "/points": writer.add_connection("/points", CLOUD, typestore=store),
            "/log": writer.add_connection("/log", TEXT, typestore=store),
        }
        for topic, stamp, data in messages:
            writer.write(connections[topic], stamp, data)


def in_order(messages):
    return sorted(messages, key=lambda message: message[1])


def probe(*arguments):
    run = subprocess.run([PROBE, *map(str, arguments)], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()


def read_by_us(path):
    """The messages in the order of format_probe, and what it says of damage."""
    topics, messages, problem = {}, [], None
    for line in probe("dump", path):
        kind, *words = line.split()
        if kind == "connection":
            topics[words[0]] = words[1]
        elif kind == "message":
            messages.append((topics[words[0]], int(words[1]), bytes.fromhex(words[2])))
        else:
            problem = line.removeprefix("problem").strip()
    return messages, problem


def read_by_rosbags(path):
    with Reader(path) as reader:
        return {c.topic: (c.msgtype, c.digest, c.msgcount, c.msgdef.data) for c in reader.connections}, [
            (connection.topic, stamp, bytes(data)) for connection, stamp, data in reader.messages()
        ]


def check(folder, messages, name, compression):
    path = folder / f"{name}.bag"
    write_bag(path, messages, compression)
    assert read_by_us(path) == (in_order(messages), ""), name
    theirs, _ = read_by_rosbags(path)
    for copy in (folder / f"{name}_plain_copy.bag", folder / f"{name}_lz4_copy.bag"):
        probe("copy", path, copy)
        ours, read = read_by_rosbags(copy)
        assert ours == theirs, (ours, theirs)
        assert in_order(read) == in_order(messages), copy
    data = path.read_bytes()
    path.write_bytes(data[: len(data) * 2 // 3])
    part, problem = read_by_us(path)
    known = set(messages)
    assert problem and len(part) > len(messages) // 3 and all(message in known for message in part), (name, problem)


with tempfile.TemporaryDirectory() as folder:
    for name, compression in [
        ("none", None),
        ("bz2", Writer.CompressionFormat.BZ2),
        ("lz4", Writer.CompressionFormat.LZ4),
    ]:
        check(pathlib.Path(folder), some_messages(60), name, compression)
print("bags agree")

"""MCAP files: of the package rosbags, and of every compression and encoding made here after the specification (mcap.dev):
every message bit for bit. Arguments: the program format_probe."""

import pathlib
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

numpy, rosbags, lz4, zstd = needs("numpy", "rosbags", "lz4.frame", "backports.zstd")
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402

PROBE = sys.argv[1]
MAGIC = b"\x89MCAP0\r\n"
PACK = {"": bytes, "lz4": lz4.compress, "zstd": zstd.compress}


def some_messages(count):
    """(topic, ns, bytes), some later in the file than in time."""
    random = numpy.random.default_rng(2)
    stamps = [1_600_000_000_000_000_000 + (i + 7 * (i % 3 == 1)) * 10_000_000 for i in range(count)]
    return [(f"/topic{i % 2}", stamp, random.integers(0, 9, 3000 + i, dtype="u1").tobytes())
            for i, stamp in enumerate(stamps)]


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def record(kind, body):
    return struct.pack("<BQ", kind, len(body)) + body


def made_file(messages, compression, encoding, chunk_messages):
    definitions = record(3, struct.pack("<H", 1) + text("pkg/msg/Type") + text("ros2msg") + struct.pack("<I", 0))
    for i in range(2):
        definitions += record(4, struct.pack("<HH", i, 1) + text(f"/topic{i}") + text(encoding) + struct.pack("<I", 0))
    records = [record(5, struct.pack("<HIQQ", int(topic[-1]), 0, stamp, stamp) + data) for topic, stamp, data in messages]
    out = MAGIC + record(1, text("ros2") + text("made"))
    if chunk_messages == 0:
        out += definitions + b"".join(records)
    else:
        for i in range(0, len(records), chunk_messages):
            plain = definitions + b"".join(records[i:i + chunk_messages])
            packed = PACK[compression](plain)
            out += record(6, struct.pack("<QQQI", 0, 0, len(plain), 0) + text(compression) +
                          struct.pack("<Q", len(packed)) + packed) + record(7, bytes(6))
    return out + record(15, bytes(4)) + record(2, bytes(20)) + MAGIC


def dump(path):
    return subprocess.run([PROBE, "dump", str(path)], capture_output=True, text=True)


def read_by_us(path):
    probe = dump(path)
    assert probe.returncode == 0, probe.stderr
    topics, messages, problem = {}, [], None
    for line in probe.stdout.splitlines():
        kind, *words = line.split()
        if kind == "connection":
            topics[words[0]] = words[1]
        elif kind == "message":
            messages.append((topics[words[0]], int(words[1]), bytes.fromhex(words[2])))
        else:
            problem = line.removeprefix("problem").strip()
    return messages, problem


def check_rosbags(folder, messages):
    store = get_typestore(Stores.ROS2_HUMBLE)
    for compressed in (False, True):
        bag = folder / f"bag{compressed}"
        writer = Writer(bag, version=8, storage_plugin=StoragePlugin.MCAP)
        if compressed:
            writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
        with writer:
            connections = {t: writer.add_connection(t, "std_msgs/msg/String", typestore=store)
                           for t in ("/topic0", "/topic1")}
            for topic, stamp, data in messages:
                writer.write(connections[topic], stamp, data)
        assert read_by_us(next(bag.glob("*.mcap"))) == (sorted(messages, key=lambda m: m[1]), ""), compressed


def check_made(folder, messages):
    expected = sorted(messages, key=lambda m: m[1])
    for compression in PACK:
        for chunk_messages in (0, 1, 7, len(messages)):
            path = folder / "made.mcap"
            data = made_file(messages, compression, "cdr", chunk_messages)
            path.write_bytes(data)
            assert read_by_us(path) == (expected, ""), (compression, chunk_messages)
            path.write_bytes(data[: len(data) * 2 // 3])
            part, problem = read_by_us(path)
            assert problem and all(m in expected for m in part), problem
            assert chunk_messages > 7 or len(part) > len(messages) // 2, (compression, chunk_messages, len(part))


with tempfile.TemporaryDirectory() as temporary:
    check_made(pathlib.Path(temporary), some_messages(40))
    check_rosbags(pathlib.Path(temporary), some_messages(40))
    wrong = pathlib.Path(temporary) / "wrong.mcap"
    wrong.write_bytes(b"no such file")
    assert "wrong.mcap: is no MCAP file" in dump(wrong).stderr
print("MCAP files agree")

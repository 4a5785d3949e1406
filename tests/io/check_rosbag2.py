"""ROS 2 bags written by the package rosbags: every message bit for bit, and their clouds as `tilth info` sees them.
Arguments: the programs format_probe and tilth."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

numpy, rosbags, zstd, mcap = needs("numpy", "rosbags", "backports.zstd", "mcap")
from mcap.writer import CompressionType, Writer as McapWriter  # noqa: E402
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer, WriterError  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402

PROBE, TILTH = sys.argv[1:3]
BEGIN = 1_600_000_000_000_000_123  # ns
STORE, STORE_1 = get_typestore(Stores.ROS2_HUMBLE), get_typestore(Stores.ROS1_NOETIC)
CLOUD, TEXT = "sensor_msgs/msg/PointCloud2", "std_msgs/msg/String"


def cloud(index, store=STORE):
    """2,400 points of 16 beams around the sensor, one turn, with times."""
    types = store.types
    count = numpy.arange(2400)
    azimuth = -2 * numpy.pi * count / len(count)
    slope = numpy.tan(numpy.radians(count % 16 * 2.0 - 15))
    points = numpy.zeros(len(count), dtype="f4,f4,f4,f4,u2,f4")
    points["f0"], points["f1"], points["f2"] = 5 * numpy.cos(azimuth), 5 * numpy.sin(azimuth), 5 * slope
    points["f3"], points["f4"], points["f5"] = count % 200, count % 16, 0.1 * count / len(count)
    field = types["sensor_msgs/msg/PointField"]
    names = ["x", "y", "z", "intensity", "ring", "time"]
    fields = [field(n, points.dtype.fields[f"f{i}"][1], 4 if n == "ring" else 7, 1) for i, n in enumerate(names)]
    stamp = types["builtin_interfaces/msg/Time"](sec=1_600_000_000 + index // 10, nanosec=index % 10 * 100_000_000)
    numbered = {"seq": index} if store is STORE_1 else {}
    header = types["std_msgs/msg/Header"](**numbered, stamp=stamp, frame_id="velodyne")
    data = numpy.frombuffer(points.tobytes(), dtype="u1")
    return types[CLOUD](header, 1, len(count), fields, False, points.itemsize, points.nbytes, data, True)


def some_messages():
    messages = []
    for i in range(12):
        stamp = BEGIN + i * 100_000_000
        messages.append(("/points", stamp, bytes(STORE.serialize_cdr(cloud(i), CLOUD))))
        messages.append(("/log", stamp - 500_000_000, bytes(STORE.serialize_cdr(STORE.types[TEXT](f"note {i}"), TEXT))))
    return messages


def write_bag(folder, messages, plugin, compression=CompressionMode.NONE):
    bag = Writer(folder, version=8, storage_plugin=plugin)
    bag.set_compression(compression, CompressionFormat.ZSTD)
    with bag as writer:
        connections = {
            "/points": writer.add_connection("/points", CLOUD, typestore=STORE),
            "/log": writer.add_connection("/log", TEXT, typestore=STORE),
        }
        for topic, stamp, data in messages:
            writer.write(connections[topic], stamp, data)


def run(*arguments):
    return subprocess.run(list(map(str, arguments)), capture_output=True, text=True)


def read_by_us(path):
    probe = run(PROBE, "dump", path)
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


def check_split_and_packed_mcap(temporary, messages):
    """A recording of two files, the second one packed, put together from two of the package."""
    for i, part in enumerate((messages[:10], messages[10:])):
        write_bag(temporary / f"part{i}", part, StoragePlugin.MCAP)
    folder = temporary / "split"
    folder.mkdir()
    shutil.copy(next((temporary / "part0").glob("*.mcap")), folder / "split_0.mcap")
    (folder / "split_1.mcap.zstd").write_bytes(zstd.compress(next((temporary / "part1").glob("*.mcap")).read_bytes()))
    info = run(TILTH, "info", folder).stdout
    assert "scans: 12 over 1.100 s" in info, info
    (folder / "split_1.mcap.zstd").write_bytes(b"nothing packed")
    assert "split_1.mcap.zstd: is no file packed" in run(TILTH, "info", folder).stderr


def check_ros1_in_mcap(temporary):
    """Messages in the serialisation of ROS 1, by the package mcap."""
    for compression in CompressionType:
        path = temporary / f"ros1_{compression.name}.mcap"
        clouds = [bytes(STORE_1.serialize_ros1(cloud(i, STORE_1), CLOUD)) for i in range(12)]
        with open(path, "wb") as file:
            writer = McapWriter(file, compression=compression)
            writer.start(profile="ros1", library="made")
            schema = writer.register_schema("sensor_msgs/PointCloud2", "ros1msg", b"")
            channel = writer.register_channel("/points", "ros1", schema)
            for i, data in enumerate(clouds):
                writer.add_message(channel, BEGIN + i * 100_000_000, data, BEGIN + i * 100_000_000)
            writer.finish()
        assert [data for *_, data in read_by_us(path)[0]] == clouds, compression
        info = run(TILTH, "info", path).stdout
        assert "scans: 12 over 1.100 s" in info and "beams: 16" in info, info


def check_split_database(temporary, messages):
    for i, part in enumerate((messages[:10], messages[10:])):
        write_bag(temporary / f"half{i}", part, StoragePlugin.SQLITE3)
    folder = temporary / "halves"
    folder.mkdir()
    for i in range(2):
        shutil.copy(next((temporary / f"half{i}").glob("*.db3")), folder / f"halves_{i}.db3")
    assert read_by_us(folder) == (sorted(messages, key=lambda message: message[1]), "")


def check_every_compression(temporary, messages):
    """Whatever the package can write is read equal to the last bit."""
    written = set()
    for plugin in StoragePlugin:
        for mode in CompressionMode:
            folder = temporary / f"{plugin.name}_{mode.name}"
            try:
                write_bag(folder, messages, plugin, mode)
            except WriterError:
                continue  # of an SQLite bag the storage cannot compress
            if plugin is StoragePlugin.SQLITE3:
                path = folder
            else:
                path = next(folder.glob("*.mcap*"))
            assert read_by_us(path) == (sorted(messages, key=lambda message: message[1]), ""), folder.name
            written.add(folder.name)
    assert len(written) >= 7, written


with tempfile.TemporaryDirectory() as temporary:
    check_every_compression(pathlib.Path(temporary), some_messages())
    check_ros1_in_mcap(pathlib.Path(temporary))
    check_split_database(pathlib.Path(temporary), some_messages())
    folder = pathlib.Path(temporary) / "a bag é"
    messages = some_messages()
    write_bag(folder, messages, StoragePlugin.SQLITE3)
    expected = sorted(messages, key=lambda message: message[1])
    database = next(folder.glob("*.db3"))
    for path in (folder, database):
        assert read_by_us(path) == (expected, ""), path
    info = run(TILTH, "info", folder)
    for line in ("topic /log: std_msgs/msg/String, 12 messages", "scans: 12 over 1.100 s", "beams: 16",
                 "points: 2400 a scan", "fields: x f32, y f32, z f32, intensity f32, ring u16, time f32"):
        assert line in info.stdout, (line, info.stdout, info.stderr)
    small = pathlib.Path(temporary) / "message"
    write_bag(small, messages, StoragePlugin.SQLITE3, CompressionMode.MESSAGE)
    assert read_by_us(small) == (expected, "")
    packed = pathlib.Path(temporary) / "file"
    write_bag(packed, messages, StoragePlugin.SQLITE3, CompressionMode.FILE)
    assert read_by_us(packed) == (expected, "")
    for path in (packed, next(packed.glob("*.zstd"))):
        assert "scans: 12 over 1.100 s" in run(TILTH, "info", path).stdout, path
    check_split_and_packed_mcap(pathlib.Path(temporary), messages)
    (folder / "metadata.yaml").unlink()
    assert read_by_us(folder) == (expected, "")

    data = database.read_bytes()
    cut = pathlib.Path(temporary) / "cut.db3"
    cut.write_bytes(data[: len(data) * 2 // 3])
    part = run(PROBE, "dump", cut)
    known = {f"{stamp} {data.hex()}" for _, stamp, data in messages}
    for line in part.stdout.splitlines():
        assert not line.startswith("message") or line.split(" ", 2)[2] in known, line[:80]
    assert part.returncode == 1 or "problem " in part.stdout
    mcap = pathlib.Path(temporary) / "mcap"
    write_bag(mcap, messages, StoragePlugin.MCAP)
    for path in (mcap, next(mcap.glob("*.mcap"))):
        assert "scans: 12 over 1.100 s" in run(TILTH, "info", path).stdout, path
    cut.write_bytes(b"no database at all" * 100)
    assert "cut.db3" in run(PROBE, "dump", cut).stderr
    shutil.rmtree(folder)

print("ROS 2 bags agree")

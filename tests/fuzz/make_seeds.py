"""Writes the seeds that need no program: python3 tests/fuzz/make_seeds.py (packets as tests/sensor/made_packets.hpp)."""
import math
import pathlib
import sqlite3
import struct
import tempfile

SEEDS = pathlib.Path(__file__).parent / "seeds"


def write(target, name, content):
    folder = SEEDS / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())


def blocks(azimuth, step, distance):
    out = b""
    for block in range(12):
        out += b"\xff\xee" + struct.pack("<H", round(azimuth + step * block) % 36000)
        out += b"".join(struct.pack("<HB", distance + 10 * slot, slot) for slot in range(32))
    return out


def short_packet(k, step, period_us, model, mode=0x37):
    columns = 6 if mode == 0x39 else 12
    return blocks(k * columns * step, step, 3000) + struct.pack("<IBB", round(1e8 + k * columns * period_us), mode, model)


def long_packet(k):
    return blocks(k * 432, 36, 3000) + bytes([26, 3, 4, 5, 6, 7]) + struct.pack("<IBB", 500000 + 1200 * k, 0x37, 0x10)


def hesai_packet(k, mode=0x37):
    head = bytes.fromhex("eeff06010000100800040101")
    body = b"".join(struct.pack("<H", (4500 * (8 * k + b)) % 36000) + b"".join(struct.pack("<HBB", 500 + i, i, 0) for i in range(16))
                    for b in range(8))
    return head + body + bytes(10) + struct.pack("<BH6BIBI", mode, 600, 124, 1, 1, 0, 0, 0, 400 * k, 0x42, k)


def device_packet():
    packet = bytearray(1206)
    packet[:8] = bytes.fromhex("a5ff005a11115555")
    packet[8:10] = struct.pack(">H", 600)
    packet[52:58] = bytes([26, 3, 4, 5, 6, 7])
    for i, angle in enumerate([-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15]):
        packet[245 + 2 * i:247 + 2 * i] = struct.pack(">h", 100 * angle + 3)
    packet[1196] = 3
    return bytes(packet)


def position_packet():
    packet = bytearray(512)
    packet[198:202] = struct.pack("<I", 393210381)
    sentence = b"$GPRMC,220632,A,3707.8324,N,12139.2864,W,000.0,144.7,111212,013.8,E,D*09\r\n"
    packet[206:206 + len(sentence)] = sentence
    return bytes(packet)


def stream(payloads):
    kinds = {1206: 0, 1212: 1, 512: 2, 568: 3, 1080: 4, 1072: 5, 1194: 6, 1262: 7, 1248: 8}
    return b"".join(struct.pack("<BI", kinds[len(p)], 100 + i) + p for i, p in enumerate(payloads))


def banked_packet(k, flags, period_us, tail):
    out = b""
    for block in range(12):
        azimuth = 3000 * (k * (12 // len(flags)) + block // len(flags)) % 36000
        out += b"\xff" + bytes([flags[block % len(flags)]]) + struct.pack("<H", azimuth)
        out += b"".join(struct.pack("<HB", 3000 + 10 * slot, slot) for slot in range(32))
    return out + struct.pack("<I", round(1e8 + k * (12 // len(flags)) * period_us)) + tail


def pandar_block(azimuth, lasers, head=b"", reserved=b""):
    return head + struct.pack("<H", azimuth % 36000) + b"".join(struct.pack("<HB", 500 + i, i) + reserved for i in range(lasers))


def xt32_packet(k):
    body = b"".join(pandar_block(4500 * (8 * k + b), 32, reserved=b"\0") for b in range(8))
    return bytes.fromhex("eeff06010000200800040101") + body + bytes(10) + struct.pack("<BH6BIBI", 0x37, 600, 124, 1, 1, 0, 0, 0, 400 * k, 0x42, k)


def qt64_packet(k):
    body = b"".join(pandar_block(4500 * (4 * k + b), 64, reserved=b"\0") for b in range(4))
    return bytes.fromhex("eeff03020000400400040100") + body + bytes(10) + struct.pack("<HIBB6BI", 600, 667 * k, 0x37, 0, 124, 1, 1, 0, 0, 0, k)


def pandar64_packet(k):
    body = b"".join(pandar_block(4500 * (6 * k + b), 64) for b in range(6))
    return bytes.fromhex("eeff400600040000") + body + bytes(8) + struct.pack("<HIBB6B", 600, 333 * k, 0x37, 0, 24, 1, 1, 0, 0, 0)


def pandar40p_packet(k):
    body = b"".join(pandar_block(4500 * (10 * k + b), 40, b"\xee\xff") for b in range(10))
    return body + bytes(8) + struct.pack("<HIBB6B", 600, 556 * k, 0x39, 0, 24, 1, 1, 0, 0, 0)


def robosense_packet(k, helios):
    head = bytes.fromhex("55aa055a0001" if helios else "55aa050a5aa550a0").ljust(20, b"\0")
    us = 1332 * k
    time = struct.pack(">HII", 0, 1700000000, us) if helios else bytes([24, 1, 1, 0, 0, 0]) + struct.pack(">HH", us // 1000, us % 1000)
    body = b"".join(b"\xff\xee" + struct.pack(">H", 3000 * (12 * k + b) % 36000) + b"".join(struct.pack(">HB", 900 + i, i) for i in range(32))
                    for b in range(12))
    return head + time + bytes([1]) + bytes(11) + body + bytes(6)


def robosense_device():
    packet = bytearray(1248)
    packet[:8] = bytes.fromhex("a5ff005a11115555")
    packet[8:10], packet[300] = struct.pack(">H", 600), 4
    for i in range(32):
        packet[468 + 3 * i:471 + 3 * i] = struct.pack(">BH", i % 2, 100 * i + 50)
        packet[564 + 3 * i:567 + 3 * i] = struct.pack(">BH", i % 2, 400)
    return bytes(packet)


def ouster_packet(k, profile):
    columns = b""
    for i in range(4):
        column = 4 * k + i
        pixels = {0: struct.pack("<IHHHH", 5000, 9, 9, 9, 0), 1: struct.pack("<IBBHHH", 5000, 9, 0, 9, 9, 0),
                  2: struct.pack("<IIHHHH", 5000 | 9 << 24, 6000 | 8 << 24, 9, 9, 9, 0), 3: struct.pack("<HBB", 600, 9, 9)}[profile]
        stamp = struct.pack("<QH", 10**9 + 195312 * column, column % 512)
        if profile == 0:
            columns += stamp + struct.pack("<HI", column // 512, 0) + 16 * pixels + b"\xff" * 4
        else:
            columns += stamp + struct.pack("<H", 1) + 16 * pixels
    return columns if profile == 0 else struct.pack("<HH", 1, 4 * k // 512) + bytes(28) + columns + bytes(32)


def hdl64_status():
    table = bytearray(b"UNIT#\0\0" + bytes(1813))
    for i in range(64):
        table[7 + 28 * i] = i
        table[8 + 28 * i:22 + 28 * i] = struct.pack("<7h", 200 - 40 * i, i, 1200, 1210, 1220, 200, 26)
    table[1818:] = struct.pack("<H", 1820)
    out = b""
    for i, value in enumerate(table):
        out += b"".join(bytes([t, 1]) for t in b"HMSDNYGTV") if i % 7 == 0 else b""
        out += bytes([ord("1") + i % 7, value])
    return out


OUSTER_JSON = """{"prod_line": "OS-1-16", "lidar_mode": "512x10", "beam_altitude_angles": [16, 15, 1], "beam_azimuth_angles": [3, -1, 3],
"lidar_origin_to_beam_origin_mm": 15.8, "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1],
"data_format": {"columns_per_frame": 512, "columns_per_packet": 16, "pixels_per_column": 3, "column_window": [3, 500],
"udp_profile_lidar": "RNG15_RFL8_NIR8"}}
"""
VELODYNE_YAML = """num_lasers: 2
distance_resolution: 0.002
lasers:
- {laser_id: 0, rot_correction: -0.1, vert_correction: 0.02, dist_correction: 1.2, dist_correction_x: 1.3, dist_correction_y: 1.25,
   vert_offset_correction: 0.2, horiz_offset_correction: 0.026, two_pt_correction_available: true}
- {laser_id: 1, rot_correction: 0.1, vert_correction: 0.01, dist_correction: 1.1, two_pt_correction_available: false}
"""
VELODYNE_XML = """<?xml version="1.0" encoding="UTF-8" standalone="yes" ?>
<!DOCTYPE boost_serialization>
<boost_serialization signature="serialization::archive" version="4"><DB class_id="0"><distLSB_>0.2</distLSB_>
<points_ class_id="8"><count>2</count><item_version>1</item_version>
<item class_id="9"><px class_id="10"><id_>0</id_><rotCorrection_>-5</rotCorrection_><vertCorrection_>-7</vertCorrection_>
<distCorrection_>120</distCorrection_><distCorrectionX_>123</distCorrectionX_><distCorrectionY_>121</distCorrectionY_>
<vertOffsetCorrection_>20</vertOffsetCorrection_><horizOffsetCorrection_>2.6</horizOffsetCorrection_></px></item>
<item><px><id_>1</id_><rotCorrection_>-3</rotCorrection_><vertCorrection_>-6.9</vertCorrection_></px></item>
</points_></DB></boost_serialization>
"""


def frame(payload, tag=b""):
    udp = struct.pack(">HHHH", 2368, 2368, len(payload) + 8, 0) + payload
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 7, 0, 64, 17, 0, bytes([192, 168, 1, 200]), b"\xff" * 4)
    return bytes(12) + tag + b"\x08\x00" + ip + udp


def capture(frames, nanoseconds=False):
    out = struct.pack("<IHHIIII", 0xA1B23C4D if nanoseconds else 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1)
    return out + b"".join(struct.pack("<IIII", 1700000000, 5 * i, len(f), len(f)) + f for i, f in enumerate(frames))


def pcapng(frames):
    def block(kind, body):
        body += bytes(-len(body) % 4)
        return struct.pack("<II", kind, len(body) + 12) + body + struct.pack("<I", len(body) + 12)

    out = block(0x0A0D0D0A, struct.pack("<IHHq", 0x1A2B3C4D, 1, 0, -1)) + block(1, struct.pack("<HHI", 1, 0, 65535))
    return out + b"".join(block(6, struct.pack("<IIIII", 0, 0, 9, len(f), len(f)) + f) for f in frames)


def points(count):
    return [(3 * math.cos(i / 9), 3 * math.sin(i / 9), (i % 16 - 8) / 9, i % 256) for i in range(count)]


def cloud_message(count):
    text = b"lidar"
    out = struct.pack("<IIII", 1, 17, 5, len(text)) + text + struct.pack("<III", 1, count, 4)
    for i, name in enumerate([b"x", b"y", b"z", b"intensity"]):
        out += struct.pack("<I", len(name)) + name + struct.pack("<IBI", 4 * i, 7, 1)
    data = b"".join(struct.pack("<4f", *p) for p in points(count))
    return out + struct.pack("<BIII", 0, 16, 16 * count, len(data)) + data + b"\x01"


def cloud_cdr(count):
    out = bytearray(b"\x00\x01\x00\x00")

    def number(kind, value):
        size = struct.calcsize(kind)
        out.extend(bytes(-(len(out) - 4) % size) + struct.pack("<" + kind, value))

    def text(value):
        number("I", len(value) + 1)
        out.extend(value + b"\x00")

    number("I", 17)
    number("I", 5)
    text(b"lidar")
    for value in (1, count, 4):
        number("I", value)
    for i, name in enumerate([b"x", b"y", b"z", b"intensity"]):
        text(name)
        number("I", 4 * i)
        number("B", 7)
        number("I", 1)
    number("B", 0)
    for value in (16, 16 * count, 16 * count):
        number("I", value)
    out.extend(b"".join(struct.pack("<4f", *p) for p in points(count)) + b"\x01")
    return bytes(out)


def scan_message(payloads, cdr):
    name = b"velodyne" + b"\x00" * cdr
    out = struct.pack("<II" if cdr else "<III", *([] if cdr else [1]), 17, 5) + struct.pack("<I", len(name)) + name
    out += bytes(-len(out) % 4) * cdr + struct.pack("<I", len(payloads))
    for payload in payloads:
        out += bytes(-len(out) % 4) * cdr + struct.pack("<II", 17, 5) + payload
    return b"\x00\x01\x00\x00" * cdr + out


def database(messages):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "bag.db3"
        bag = sqlite3.connect(path)
        bag.execute("PRAGMA page_size = 512")
        bag.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)")
        bag.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)")
        bag.execute("INSERT INTO topics VALUES (1, '/points', 'sensor_msgs/msg/PointCloud2', 'cdr')")
        for i, message in enumerate(messages):
            bag.execute("INSERT INTO messages VALUES (?, 1, ?, ?)", (i, 1000 * i, message))
        bag.commit()
        bag.close()
        return path.read_bytes()


def mcap(messages, chunked):
    def text(value):
        return struct.pack("<I", len(value)) + value

    def record(kind, body):
        return struct.pack("<BQ", kind, len(body)) + body

    magic = b"\x89MCAP0\r\n"
    records = record(3, struct.pack("<H", 1) + text(b"sensor_msgs/msg/PointCloud2") + text(b"ros2msg") + text(b""))
    records += record(4, struct.pack("<HH", 0, 1) + text(b"/points") + text(b"cdr") + text(b""))
    for i, message in enumerate(messages):
        records += record(5, struct.pack("<HIQQ", 0, i, 1000 * i, 1000 * i) + message)
    if chunked:
        head = struct.pack("<QQQI", 0, 9, len(records), 0) + text(b"")
        records = record(6, head + struct.pack("<Q", len(records)) + records)
    return magic + record(1, text(b"ros2") + text(b"")) + records + record(15, bytes(4)) + magic


def pcd(kind, body):
    return (f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 40\n"
            f"HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 40\nDATA {kind}\n").encode() + body


def ply(kind, body):
    return (f"ply\nformat {kind} 1.0\ncomment made\nelement vertex 40\nproperty float x\nproperty float y\n"
            f"property float z\nproperty float intensity\nend_header\n").encode() + body


def las(minor, kind, size, rows):
    header = 375 if minor == 4 else 227
    begin = struct.pack("<4sHH16sBB32s32sHHHII", b"LASF", 0, 0, b"", 1, minor, b"", b"", 0, 0, header, header, 0)
    begin += struct.pack("<BHI20s", kind, size, 0 if minor == 4 else len(rows), b"")
    begin += struct.pack("<12d", 0.001, 0.001, 0.001, 400000, 5600000, 0, 9, 0, 9, 0, 9, 0)
    if minor == 4:
        begin += struct.pack("<QQIQ120s", 0, 0, 0, len(rows), b"")
    points = [struct.pack("<iiiH", *(round(1000 * v) for v in (x, y, z)), int(i)) for x, y, z, i in rows]
    return begin + b"".join(point.ljust(size, b"\x01") for point in points)


def map_files():
    place = struct.pack("<8d21dQIIII", 5.0, 1, 2, 3, 0, 0, 0, 1, *([1e-4] * 21), 64, 32, 7, 2, 0)
    cells = b"".join(struct.pack("<iiB", x, y, 1 << (x & 7)) for y in (-3, 4) for x in (-5, 2, 9))
    patches = 4
    floats = [[float(i) for i in range(patches)]] * 3 + [[0.1] * patches] * 3 + [[0.0] * patches] * 3
    floats += [[1.0] * patches] + [[0.0] * patches] * 2 + [[1e-4] * patches]
    fields = b"".join(struct.pack(f"<{patches}f", *column) for column in floats)
    fields += struct.pack(f"<{2 * patches}H", *([9] * patches), *range(patches)) + b"\x01" * patches
    files = "".join(f"  {name}:\n    bytes: 10\n    crc32: 99\n" for name in ("places", "uprights", "patches", "pose_graph"))
    text = f"format: 1\nprogram: '1.2.3'\nsource: 'it''s \"x\"'\nplaces: 2\nfiles:\n{files}"
    return {"places": b"\x00" + place + place, "uprights": b"\x01" + cells, "patches": b"\x02" + fields,
            "map.yaml": b"\x03" + text.encode()}


def main():
    vlp16 = [short_packet(k, 39.8, 110.592, 0x22) for k in range(3)]
    fast = [short_packet(k, 3000, 110.592, 0x22) for k in range(4)]  # many turns in few packets
    dual = [short_packet(k, 3000, 110.592, 0x22, 0x39) for k in range(4)]
    hdl32 = [short_packet(k, 16.6, 46.08, 0x21) for k in range(2)]
    c16 = [short_packet(k, 36, 100, 0x10) for k in range(2)]
    for name, payloads in {"vlp16": vlp16 + [position_packet()], "fast": fast, "dual": dual, "hdl32": hdl32,
                           "c16_v3": [device_packet()] + c16, "c16_v4": [long_packet(k) for k in range(3)],
                           "xt16": [hesai_packet(k) for k in range(4)],
                           "xt16_dual": [hesai_packet(k, 0x39) for k in range(4)]}.items():
        write("packets", name, stream(payloads))
    vls128, hdl64 = bytes([0xEE, 0xDD, 0xCC, 0xBB]), bytes([0xEE, 0xDD])
    for name, payloads in {"vls128": [banked_packet(k, vls128, 53.3, b"\x37\xa1") for k in range(6)],
                           "hdl64": [banked_packet(k, hdl64, 57.6, b"H\x01") for k in range(4)],
                           "xt32": [xt32_packet(k) for k in range(3)], "qt64": [qt64_packet(k) for k in range(4)],
                           "pandar64": [pandar64_packet(k) for k in range(3)],
                           "pandar40p": [pandar40p_packet(k) for k in range(3)],
                           "rs16": [robosense_packet(k, False) for k in range(3)],
                           "helios": [robosense_device()] + [robosense_packet(k, True) for k in range(3)]}.items():
        write("packets", name, stream(payloads))
    for profile in range(4):
        payloads = [ouster_packet(k, profile) for k in list(range(120, 130)) + [131, 256]]
        write("ouster", f"profile_{profile}", bytes([profile]) + b"".join(struct.pack("<BI", 0, 1000 + i) + p for i, p in enumerate(payloads)))
    write("hdl64_status", "s2", hdl64_status())
    write("sensor_file", "ouster.json", OUSTER_JSON)
    write("sensor_file", "velodyne.yaml", VELODYNE_YAML)
    write("sensor_file", "db.xml", VELODYNE_XML)
    write("sensor_file", "angles.csv", "Channel,Elevation,Azimuth\n1,14.9,1.2\n2,11.0,-1.2\n")
    write("sensor_file", "robosense.csv", "14.94,-4.07\t\n13.03,3.63\n")
    write("device_packet", "robosense", robosense_device())
    frames = [frame(vlp16[0]), frame(position_packet(), b"\x81\x00\x00\x05"), frame(b"other")]
    write("pcap", "ethernet.pcap", capture(frames))
    write("pcap", "small.pcap", capture([frame(b"other"), frame(bytes(40), b"\x81\x00\x00\x05")], True))
    write("pcap", "small.pcapng", pcapng([frame(b"other"), frame(bytes(41))]))
    write("payload_file", "vlp16", b"".join(vlp16))
    write("payload_file", "c16_v4", b"".join(long_packet(k) for k in range(3)))
    write("payload_file", "damaged", vlp16[0] + b"\xff\xee\x00" + vlp16[1])
    rows = points(40)
    raw = b"".join(struct.pack("<4f", *p) for p in rows)
    text = "".join("%.3f %.3f %.3f %d\n" % p for p in rows).encode()
    literal = b"".join(bytes([len(part) - 1]) + part for part in (raw[i:i + 32] for i in range(0, len(raw), 32)))
    write("pcd", "ascii.pcd", pcd("ascii", text))
    write("pcd", "binary.pcd", pcd("binary", raw))
    write("pcd", "compressed.pcd", pcd("binary_compressed", struct.pack("<II", len(literal), len(raw)) + literal))
    write("ply", "ascii.ply", ply("ascii", text))
    write("ply", "little.ply", ply("binary_little_endian", raw))
    write("ply", "big.ply", ply("binary_big_endian", b"".join(struct.pack(">4f", *p) for p in rows)))
    write("las", "old.las", las(2, 3, 34, rows))
    write("las", "wide.las", las(4, 6, 32, rows))
    for name, content in map_files().items():
        write("map_file", name, content)
    write("kitti_bin", "scan.bin", raw)
    write("kitti_bin", "five.bin", b"".join(struct.pack("<5f", *p, i % 16) for i, p in enumerate(rows)))
    write("kitti_bin", "six.bin", b"".join(struct.pack("<6f", *p, i % 16, i / 400) for i, p in enumerate(rows)))
    lower = "version 0.7\nfields x y e z\nsize 4 4 2 4\ntype f f u f\ncount 1 1 0 1\nwidth 3\nheight 1\npoints 3\n"
    write("pcd", "count_zero.pcd", lower + "data ascii\n" + "1 2 3\n" * 3)
    write("pcd", "count_zero_binary.pcd", (lower + "data binary\n").encode() + struct.pack("<ffHf", 1, 2, 7, 3) * 3)
    listed = "ply\nformat %s 1.0\nelement vertex 2\nproperty list uchar short seen\nproperty float x\n" \
             "property float y\nproperty float z\nend_header\n"
    write("ply", "lists.ply", listed % "ascii" + "2 7 8 1 2 3\n0 4 5 6\n")
    write("ply", "lists_binary.ply", (listed % "binary_little_endian").encode() + struct.pack("<Bhhfff", 2, 7, 8, 1, 2, 3)
          + struct.pack("<Bfff", 0, 4, 5, 6))
    write("point_cloud2", "cloud", cloud_message(40))
    organised = cloud_message(40).replace(struct.pack("<II", 1, 40), struct.pack("<II", 4, 10), 1)
    organised = organised.replace(struct.pack("<BIII", 0, 16, 640, 640), struct.pack("<BIII", 1, 16, 0, 640), 1)
    write("point_cloud2", "organised_row_step_0", organised)
    write("date_times_file", "timestamps.txt", "2011-09-26 13:02:25.951199337\n2011-09-26 13:02:26.054\n")
    write("point_cloud2_cdr", "cloud", cloud_cdr(40))
    mount = struct.pack("<IIII", 1, 0, 17, 5) + struct.pack("<I", 4) + b"base" + struct.pack("<I", 5) + b"lidar"
    write("tf_message", "ros1", b"\x00" + mount + struct.pack("<7d", 0.3, 0, 0.7, 0, 0, 0, 1))
    guess = struct.pack("<IIII", 1, 0, 17, 3) + b"map" + struct.pack("<7d", 3, -1, 0, 0, 0, 0.6, 0.8) + struct.pack("<36d", *[0] * 36)
    write("pose_guess", "ros1", b"\x00" + guess)
    write("packet_message", "velodyne_ros1", b"\x01" + scan_message(vlp16[:2], False))
    write("packet_message", "velodyne_cdr", b"\x03" + scan_message(vlp16[:2], True))
    write("packet_message", "lslidar", b"\x00" + struct.pack("<II", 17, 5) + long_packet(0))
    write("packet_message", "pandar", b"\x04" + struct.pack("<II", 17, 5) + hesai_packet(0) + bytes(932) + struct.pack("<I", 568))
    write("packet_message", "ouster_cdr", b"\x0a\x00\x01\x00\x00" + struct.pack("<I", 880) + ouster_packet(0, 1))
    write("packet_message", "robosense", b"\x09" + struct.pack("<IIII", 1, 17, 5, 2) + b"rs\x00\x01" + struct.pack("<I", 1248) + robosense_packet(0, True))
    write("rosbag2", "bag.db3", database([cloud_cdr(10), cloud_cdr(12)]))
    write("mcap", "plain.mcap", mcap([cloud_cdr(10), b"12345"], False))
    write("mcap", "chunked.mcap", mcap([cloud_cdr(10), b"12345"], True))
    write("pose_file", "tum.txt", "# t x y z qx qy qz qw\n0.1 1 2 3 0 0 0 1\n0.2 1 2 3 0 0 0.7071068 0.7071068\n")
    write("pose_file", "kitti.txt", "1 0 0 1 0 1 0 2 0 0 1 3\n1 0 0 2 0 1 0 2 0 0 1 3\n")
    write("pose_file", "euroc.csv", "\ufeff#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
          "q_RS_z [], v_RS_R_x [m s^-1]\r\n1403636579750000000,1,-2,3,0.5,0.1,0.5,0.7,9\r\n")
    write("pose_file", "ros.csv", "%time,field.header.stamp,field.header.frame_id,field.pose.position.x,field.pose.position.y,"
          "field.pose.position.z,field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,"
          "field.pose.orientation.w\n2,1403636579750000000,,1,-2,3,0.1,0.5,0.7,0.5\n")
    write("pose_file", "sec_nsec.txt", "sec nsec x [mm] y [mm] z [mm] w x y z\n1 750000000 1000 -2000 3000 1 0 0 0\n")
    write("pose_file", "names.csv", "t;pos_x;pos_y;pos_z;quat_w;quat_x;quat_y;quat_z\n1;1;2;3;1;0;0;0;\n")
    write("device_packet", "leishen_v3", device_packet())
    write("device_packet", "velodyne_position", position_packet())
    values = " ".join(["1 2 3 0 0 0 1"] + ["1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1"])
    write("g2o", "graph.g2o", "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 2 3 0 0 0 1\nFIX 0\n"
          f"EDGE_SE3:QUAT 0 1 {values}\n")
    write("rosbag2_metadata", "metadata.yaml", "rosbag2_bagfile_information:\n  version: 8\n  storage_identifier: mcap\n"
          "  relative_file_paths:\n    - bag_0.mcap\n    - sub/bag_1.mcap.zstd\n  message_count: 2\n")
    write("rosbag2_metadata", "empty_storage.yaml", "rosbag2_bagfile_information:\n  storage_identifier: \"\"\n")
    write("view_client", "subscribe", 'foxglove.sdk.v1, foxglove.websocket.v1\nhttp://localhost:8080\n'
          '{"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":1,"channelId":2}]}\n'
          '{"op":"unsubscribe","subscriptionIds":[1]}\n')
    write("view_client", "others", 'foxglove.websocket.v1\nhttps://app.foxglove.dev\n{"op":"getParameters","parameterNames":[],"id":"x"}\n'
          '{"op":"fetchAsset","uri":"package://a/b.urdf","requestId":1}\n{"op":"advertise","channels":[{"id":1,"topic":"/x"}]}\n')
    write("times_file", "times.txt", "0.0\n0.1\n1e-1\n")
    write("beam_file", "beams.yaml", "# measured minus true\nversion: 1\nrange: [0.02, -0.01]\nelevation: [0.15, -0.1]\n"
          "azimuth: []\nencoder: [0.03, 0, 0.01, -0.01]\nrange_scale: 0.001\nwalk: 0.02\nbright: 150\n")
    triangle = "".join("  - [" + "0, " * i + "1e-6]\n" for i in range(7))
    write("beam_file", "covariance.yaml", "version: 1\nrange: [0.02]\ndeviations: {range: [0.001]}\ncovariance:\n" + triangle)
    write("config", "config.yaml", "pipeline: improved_floam\nsor:\n  k: 8\n  alpha: 1.0\nlist: [1, 2]\nanchor: &a {b: c}\n")


if __name__ == "__main__":
    main()

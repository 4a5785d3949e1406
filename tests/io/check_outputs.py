"""What tilth run and tilth convert write for other programs: MCAP by the packages mcap and rosbags, LAS by laspy, each held
against the PCD and TUM files of the same run. Argument: the program tilth."""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

numpy, laspy, pyproj, mcap, mcap_ros2, rosbags, pypcd4 = needs(*"numpy laspy pyproj mcap mcap_ros2 rosbags pypcd4".split())
from mcap.reader import make_reader  # noqa: E402
from mcap_ros2.decoder import DecoderFactory  # noqa: E402
from rosbags.highlevel import AnyReader  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402

TILTH = sys.argv[1]
SCENE = "sim://corridor?duration=1.2&seed=4&sensor=vlp16"


def tilth(*arguments):
    done = subprocess.run([TILTH, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def seconds(stamp):
    return stamp.sec + 1e-9 * stamp.nanosec


def pose_of(position, q):
    return [position.x, position.y, position.z, q.x, q.y, q.z, q.w]


def cloud_of(message, fields):
    dtype = numpy.dtype({"names": fields, "formats": ["f4"] * len(fields),
                         "offsets": [f.offset for name in fields for f in message.fields if f.name == name],
                         "itemsize": message.point_step})
    return numpy.frombuffer(bytes(message.data), dtype)


def close(a, b, tolerance):
    return numpy.abs(numpy.asarray(a, float) - numpy.asarray(b, float)).max() <= tolerance


def read_mcap(path):
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        statistics = reader.get_summary().statistics
        messages = [(channel.topic, schema.name, message.log_time, decoded)
                    for schema, channel, message, decoded in reader.iter_decoded_messages()]
    assert statistics.message_count == len(messages)
    return messages


def check_run(folder):
    out = folder / "run"
    tilth("run", SCENE, "--out", out, "--map-format", "pcd,ply,las", "--mcap", "--quiet")
    poses = numpy.loadtxt(out / "trajectory.tum", ndmin=2)
    points = pypcd4.PointCloud.from_path(out / "map.pcd").numpy(("x", "y", "z", "intensity"))
    check_map_las(laspy.read(out / "map.las"), points)
    assert check_map_crs(laspy.read(out / "map.las"), "LOCAL_CS[").is_engineering
    tilth("run", SCENE, "--out", folder / "utm", "--map-format", "las", "--origin", "32N,691000,5335000,520,90", "--quiet")
    check_map_utm(laspy.read(folder / "utm" / "map.las"), points)
    messages = read_mcap(out / "run.mcap")
    by_topic = {topic: [(t, m) for name, _, t, m in messages if name == topic] for topic, *_ in messages}
    assert {topic: len(found) for topic, found in by_topic.items()} == {
        "/path": 1, "/map": 1, "/tf": len(poses), "/odometry": len(poses), "/scan": len(poses), "/diagnostics": len(poses)}
    check_scans_in_world(by_topic["/scan"], poses, points)
    cloud = cloud_of(by_topic["/map"][0][1], ["x", "y", "z", "intensity"])
    assert all(numpy.array_equal(cloud[name], points[:, i]) for i, name in enumerate(cloud.dtype.names))
    path = by_topic["/path"][0][1]
    assert path.header.frame_id == "world"
    for row, (t, odometry), (_, tf), in_path in zip(poses, by_topic["/odometry"], by_topic["/tf"], path.poses, strict=True):
        transform = tf.transforms[0]
        assert (odometry.header.frame_id, odometry.child_frame_id) == ("world", "lidar")
        assert (transform.header.frame_id, transform.child_frame_id) == ("world", "lidar")
        assert abs(t * 1e-9 - row[0]) < 1e-6 and abs(seconds(odometry.header.stamp) - row[0]) < 2e-9
        for other in (pose_of(odometry.pose.pose.position, odometry.pose.pose.orientation),
                      pose_of(transform.transform.translation, transform.transform.rotation),
                      pose_of(in_path.pose.position, in_path.pose.orientation)):
            assert close(row[1:4], other[:3], 1e-12)
            assert min(numpy.abs(row[4:] - other[3:]).max(), numpy.abs(row[4:] + other[3:]).max()) < 1e-9
        covariance = numpy.reshape(odometry.pose.covariance, (6, 6))
        assert close(covariance, covariance.T, 1e-18) and (numpy.linalg.eigvalsh(covariance) > -1e-15).all()
    for _, state in by_topic["/diagnostics"]:
        (status,) = state.status
        values = {pair.key: pair.value for pair in status.values}
        assert status.level in (0, b"\0") and values["track"] == "tracking" and float(values["register_ms"]) > 0
    with AnyReader([out / "run.mcap"], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        kinds = {reader.deserialize(raw, connection.msgtype).__msgtype__ for connection, _, raw in reader.messages()}
    assert kinds == {"nav_msgs/msg/Path", "sensor_msgs/msg/PointCloud2", "tf2_msgs/msg/TFMessage", "nav_msgs/msg/Odometry",
                     "diagnostic_msgs/msg/DiagnosticArray"}


def matrix_of(pose):
    x, y, z, w = pose[3:]
    T = numpy.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = pose[:3]
    return T


def check_base(folder):
    """With --base-from-lidar: frames, transforms that lead to the LiDAR, covariances by the adjoint, scans in the map."""
    out = {}
    for name, more in (("lidar", ()), ("base", ("--base-from-lidar", "0.5,0.1,0.4,0,0,90"))):
        tilth("run", SCENE, "--out", folder / name, "--mcap", "--quiet", *more)
        out[name] = {}
        for topic, _, _, message in read_mcap(folder / name / "run.mcap"):
            out[name].setdefault(topic, []).append(message)
    poses = numpy.loadtxt(folder / "base" / "trajectory.tum", ndmin=2)
    mount = numpy.array([[0, -1, 0, 0.5], [1, 0, 0, 0.1], [0, 0, 1, 0.4], [0, 0, 0, 1.0]])
    for row, tf, odometry, before in zip(poses, out["base"]["/tf"], out["base"]["/odometry"], out["lidar"]["/odometry"], strict=True):
        to_base, to_lidar = tf.transforms
        assert (to_base.header.frame_id, to_base.child_frame_id) == ("world", "base_link") and odometry.child_frame_id == "base_link"
        assert (to_lidar.header.frame_id, to_lidar.child_frame_id) == ("base_link", "lidar")
        assert close(matrix_of(pose_of(to_lidar.transform.translation, to_lidar.transform.rotation)), mount, 1e-12)
        of_base = matrix_of(pose_of(odometry.pose.pose.position, odometry.pose.pose.orientation))
        of_lidar = matrix_of(pose_of(before.pose.pose.position, before.pose.pose.orientation))
        assert close(of_base, matrix_of(row[1:]), 1e-9) and close(of_base, mount @ of_lidar @ numpy.linalg.inv(mount), 1e-9)
        check_covariance(odometry, before, of_base[:3, :3], mount)
    cloud = cloud_of(out["base"]["/map"][0], ["x", "y", "z"])
    assert abs(len(cloud) - len(cloud_of(out["lidar"]["/map"][0], ["x", "y", "z"]))) < 0.05 * len(cloud)


def check_covariance(of_base, of_lidar, rotation, mount):
    """In the axes of the base's world: what turns the LiDAR moves the base by their distance."""
    covariance, before = (numpy.reshape(m.pose.covariance, (6, 6)) for m in (of_base, of_lidar))
    axes = numpy.kron(numpy.eye(2), mount[:3, :3])  # from the world that begins at the LiDAR to that of the base
    lever = rotation @ mount[:3, 3]  # [m] from the base to the LiDAR
    x, y, z = lever
    moved = numpy.eye(6)
    moved[:3, 3:] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]  # error of the base = that of the LiDAR - error of rotation x lever
    expected = moved @ axes @ before @ axes.T @ moved.T
    assert close(covariance, expected, 1e-6 * numpy.abs(expected).max())


def check_scans_in_world(scans, poses, map_points):
    """Each scan, put into the world by the pose of its stamp, lies where the map is."""
    voxels = {tuple(v) for v in numpy.floor(map_points[:, :3] / 0.1).astype(int)}
    for (t, scan), row in zip(scans, poses, strict=True):
        assert scan.header.frame_id == "lidar" and abs(seconds(scan.header.stamp) - row[0]) < 2e-9
        assert [f.name for f in scan.fields] == ["x", "y", "z", "intensity", "ring"] and 4000 < scan.width <= 5000
        cloud = cloud_of(scan, ["x", "y", "z"])
        T_world_lidar = matrix_of(row[1:])
        world = numpy.stack([cloud["x"], cloud["y"], cloud["z"]], 1) @ T_world_lidar[:3, :3].T + row[1:4]
        inside = [tuple(v) in voxels for v in numpy.floor(world / 0.1).astype(int)]
        assert numpy.mean(inside) > 0.999, numpy.mean(inside)


def check_map_las(las, points):
    assert str(las.header.version) == "1.4" and las.header.point_format.id == 6
    assert len(las.points) == len(points) == las.header.number_of_points_by_return[0]
    assert close(las.xyz, points[:, :3], 0.51e-4)
    assert close(las.intensity, points[:, 3].round(), 0)
    assert close(las.header.mins, points[:, :3].min(0), 1e-4) and close(las.header.maxs, points[:, :3].max(0), 1e-4)


def check_map_crs(las, begin):
    text, = [record.string for record in las.header.vlrs.get("WktCoordinateSystemVlr")]
    assert las.header.global_encoding.wkt and text.startswith(begin), text
    return pyproj.CRS.from_wkt(text)


def check_map_utm(las, points):
    assert close(las.xyz, points[:, [1, 0, 2]] * [-1, 1, 1] + [691000, 5335000, 520], 0.6e-4)  # x is north, y west
    assert check_map_crs(las, "PROJCS[") == pyproj.CRS.from_epsg(32632)


def check_scans(folder):
    for target in ("scans.mcap", "scans.bag", "pcd", "las"):
        more = ("--format", target) if "." not in target else ()
        tilth("convert", SCENE, folder / target, *more, "--quiet")
    stamps = numpy.loadtxt(folder / "pcd" / "times.txt")
    clouds = [pypcd4.PointCloud.from_path(path) for path in sorted((folder / "pcd" / "scans").iterdir())]
    messages = read_mcap(folder / "scans.mcap")
    assert len(messages) == len(clouds) == len(stamps) > 5
    las = [laspy.read(path) for path in sorted((folder / "las" / "scans").iterdir())]
    for stamp, cloud, (topic, kind, t, message), scan in zip(stamps, clouds, messages, las, strict=True):
        assert (topic, kind) == ("/points", "sensor_msgs/msg/PointCloud2")
        assert abs(seconds(message.header.stamp) - stamp) < 2e-9 and abs(t * 1e-9 - stamp) < 1e-6
        assert [f.name for f in message.fields] == list(cloud.fields) == ["x", "y", "z", "intensity", "ring", "time"]
        assert bytes(message.data) == cloud.pc_data.tobytes()
        x, y, z, ring, time = cloud.numpy(("x", "y", "z", "ring", "time")).T
        assert close(scan.xyz, numpy.stack([x, y, z], 1), 0.51e-4)
        assert close(scan.user_data, ring, 0) and close(scan.gps_time, stamp + time, 1e-9)
    with AnyReader([folder / "scans.bag"]) as reader:
        assert [bytes(reader.deserialize(raw, c.msgtype).data) for c, _, raw in reader.messages()] == [
            bytes(message.data) for *_, message in messages]


with tempfile.TemporaryDirectory() as temporary:
    check_run(pathlib.Path(temporary))
    check_base(pathlib.Path(temporary))
    check_scans(pathlib.Path(temporary))
print("other programs read what is written")

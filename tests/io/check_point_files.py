"""PCD and PLY against the packages pypcd4 and plyfile, both ways; LAS as laspy writes it. Arguments: the program format_probe."""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

numpy, pypcd4, plyfile, laspy = needs("numpy", "pypcd4", "plyfile", "laspy")
PROBE = sys.argv[1]
FIELDS = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("intensity", "u1"), ("ring", "u2"), ("time", "f8")]


def some_points(count):
    random = numpy.random.default_rng(5)
    points = numpy.zeros(count, dtype=FIELDS)
    for axis in "xyz":
        points[axis] = random.normal(0, 30, count)
    points["intensity"] = random.integers(0, 256, count)
    points["ring"] = numpy.arange(count) % 16
    points["time"] = numpy.arange(count) * 55.296e-6
    points["x"][3] = numpy.nan
    return points


def probe(*arguments):
    run = subprocess.run([PROBE, *map(str, arguments)], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def expect_read(path, points):
    names, *rows = probe("dump", path).splitlines()
    assert names.split() == [name for name, _ in FIELDS], names
    values = numpy.array([[float(word) for word in row.split()] for row in rows])
    for column, (name, _) in enumerate(FIELDS):
        numpy.testing.assert_array_equal(values[:, column], points[name].astype("f8"), f"{path.name} {name}")


def check_pcd(folder, points):
    types = [numpy.dtype(kind).type for _, kind in FIELDS]
    cloud = pypcd4.PointCloud.from_points([points[name] for name, _ in FIELDS], [name for name, _ in FIELDS], types)
    for encoding in (pypcd4.Encoding.ASCII, pypcd4.Encoding.BINARY, pypcd4.Encoding.BINARY_COMPRESSED):
        path = folder / f"{encoding.name}.pcd"
        cloud.save(path, encoding=encoding)
        head = path.read_bytes()[:600]
        assert f"DATA {encoding.value.lower()}".encode() in head, head
        if encoding.value.lower() != "ascii":  # its text rounds floats
            expect_read(path, points)
        else:
            probe("dump", path)
    probe("copy", folder / "BINARY.pcd", folder / "ours.pcd")
    back = pypcd4.PointCloud.from_path(folder / "ours.pcd").pc_data
    for name, kind in FIELDS:
        assert back[name].dtype == kind, (name, back[name].dtype)
        numpy.testing.assert_array_equal(back[name], points[name], name)


def check_ply(folder, points):
    corners = numpy.array([([0, 1, 2], 7)], dtype=[("vertex_indices", "i4", (3,)), ("flag", "u1")])
    elements = [plyfile.PlyElement.describe(corners, "face"), plyfile.PlyElement.describe(points, "vertex")]
    for name, text, order in [("ascii", True, "<"), ("little", False, "<"), ("big", False, ">")]:
        path = folder / f"{name}.ply"
        plyfile.PlyData(elements, text=text, byte_order=order).write(path)
        if text:
            probe("dump", path)
        else:
            expect_read(path, points)
    probe("copy", folder / "big.ply", folder / "ours.ply")
    back = plyfile.PlyData.read(folder / "ours.ply")["vertex"].data
    for name, kind in FIELDS:
        assert back[name].dtype == kind, (name, back[name].dtype)
        numpy.testing.assert_array_equal(back[name], points[name], name)


def check_las(folder, points):
    for version, kind in [("1.2", 3), ("1.3", 1), ("1.4", 6), ("1.4", 7)]:
        header = laspy.LasHeader(version=version, point_format=kind)
        header.scales, header.offsets = [0.001] * 3, [400000, 5600000, 100]
        las = laspy.LasData(header)
        las.x, las.y, las.z = 400000 + points["y"], 5600000 + points["y"], 100 + points["z"]
        las.intensity = points["intensity"]
        las.classification = points["ring"] % 2 * 6 + 1  # 1 not classified, 7 noise
        path = folder / f"{version}_{kind}.las"
        las.write(path)
        names, *rows = probe("dump", path).splitlines()
        assert names.split() == ["x", "y", "z", "intensity"], names
        kept = las.points[las.classification == 1]
        expected = numpy.column_stack([kept.x, kept.y, kept.z, kept.intensity])
        numpy.testing.assert_allclose([[float(word) for word in row.split()] for row in rows], expected, rtol=0, atol=1e-8)


with tempfile.TemporaryDirectory() as name:
    check_pcd(pathlib.Path(name), some_points(1000))
    check_ply(pathlib.Path(name), some_points(1000))
    check_las(pathlib.Path(name), some_points(1000))
print("point files agree")

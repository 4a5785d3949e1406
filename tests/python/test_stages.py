"""Single stages and files of clouds, held against numpy and scipy and other people's readers."""

import numpy as np
import pytest
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation

import tilth


def motion(angles, translation):
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler("xyz", angles).as_matrix()
    T[:3, 3] = translation
    return T


def apply(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


@pytest.fixture(scope="module")
def still():
    """A scan without motion: of a sensor that sees all at once."""
    return tilth.simulate("plaza", seed=3, duration=1, snapshot=True, people=0)[0]


def test_a_moved_cloud_is_brought_back(still):
    T_moved_target = motion([0.01, -0.02, 0.1], [0.4, -0.3, 0.05])
    moved = tilth.Scan(apply(T_moved_target, still.points), rings=still.rings, stamp=0.0)
    found = tilth.register(moved, still, np.eye(4))
    assert found.answer == "found" and np.array_equal(found.hypotheses[0], found.T_target_source)
    assert found.converged and found.degenerate_directions == 0 and found.matches > 200
    assert found.T_target_source @ T_moved_target == pytest.approx(np.eye(4), abs=0.01)
    assert np.linalg.eigvalsh(found.covariance).min() > 0


def test_a_guess_brings_it_farther(still):
    T_moved_target = motion([0, 0, 1.5], [6.0, -4.0, 0.0])
    moved = apply(T_moved_target, still.points)
    guess = np.linalg.inv(motion([0, 0, 1.45], [6.2, -4.1, 0.0]))
    found = tilth.register(moved, still.points, guess)
    assert found.converged and found.T_target_source @ T_moved_target == pytest.approx(np.eye(4), abs=0.05)


def test_clouds_that_do_not_match_say_so(still):
    guess = motion([0, 0, 0.1], [1, 0, 0])
    found = tilth.register(still.points + 500, still.points, guess)
    assert not found.converged and np.array_equal(found.T_target_source, guess) and found.answer == "not_found"
    assert not tilth.register(np.empty((0, 3)), still.points, np.eye(4)).converged
    with pytest.raises(tilth.Error, match="T_init: is no rigid motion"):
        tilth.register(still, still, 2 * np.eye(4))
    with pytest.raises(tilth.Error, match=r"T_init: has the shape \(3, 3\)"):
        tilth.register(still, still, np.eye(3))
    with pytest.raises(tilth.Error, match="coarse_voxel"):
        tilth.register(still, still, coarse_voxel=0)
    with pytest.raises(tilth.Error, match="find"):
        tilth.register(still, still, np.eye(4), find={"min_overlap": 0.5})


@pytest.fixture(scope="module")
def standing():
    """By scene: three scans of a drive, 1 s apart, each taken at once, and where."""
    scenes = {}
    for name in ("plaza", "office"):
        drive = tilth.simulate(name, seed=701, duration=8, snapshot=True, people=2)
        chosen = [drive[i] for i in (40, 50, 60)]
        poses = [drive.truth.poses[np.abs(drive.truth.stamps - scan.stamp).argmin()] for scan in chosen]
        scenes[name] = list(zip(chosen, poses, strict=True))
    return scenes


def test_a_cloud_is_found_without_a_guess(standing):
    rng = np.random.default_rng(702)
    (source, T_world_source), (target, T_world_target), _ = standing["plaza"]
    for rings in (source.rings, None):
        for _ in range(3):
            tilts = rng.uniform(-0.2, 0.2, 2)
            T_turned_source = motion([*tilts, rng.uniform(-np.pi, np.pi)], [0, 0, 0])
            turned = tilth.Scan(apply(T_turned_source, source.points), rings=rings, stamp=0.0)
            found = tilth.register(turned, target)
            assert found.answer == "found" and found.converged and len(found.hypotheses) == 1
            truth = np.linalg.inv(T_world_target) @ T_world_source @ np.linalg.inv(T_turned_source)
            assert found.T_target_source @ np.linalg.inv(truth) == pytest.approx(np.eye(4), abs=0.05)


def test_clouds_of_other_scenes_are_not_found(standing):
    for source, _ in standing["plaza"]:
        for target, _ in standing["office"]:
            for found in (tilth.register(source, target), tilth.register(target, source)):
                assert found.answer != "found" and not found.converged and np.isnan(found.T_target_source).all()
    empty = tilth.register(np.empty((0, 3)), source)
    assert empty.answer == "not_found" and empty.hypotheses.shape == (0, 4, 4)


def test_a_hall_that_looks_alike_four_ways_is_ambiguous():
    yaw, up = np.meshgrid(np.arange(1800) * np.pi / 900, np.radians(np.arange(-15, 16, 2)))
    beams = np.stack([np.cos(up) * np.cos(yaw), np.cos(up) * np.sin(yaw), np.sin(up)], axis=-1)
    ranges = 6 / np.abs(beams[..., :2]).max(axis=-1)
    ranges = np.where(up < 0, np.minimum(ranges, 1 / np.maximum(-beams[..., 2], 1e-9)), ranges)
    hall = (ranges[..., None] * beams).reshape(-1, 3)
    found = tilth.register(apply(motion([0, 0, 0.7], [0, 0, 0]), hall), hall)
    assert found.answer == "ambiguous" and np.isnan(found.T_target_source).all()
    back = np.linalg.inv(motion([0, 0, 0.7], [0, 0, 0]))
    assert min(np.abs(hypothesis - back).max() for hypothesis in found.hypotheses) < 0.02


@pytest.mark.parametrize("rings", [True, False])
def test_neighbours_are_those_of_scipy(rings, scan):
    points = scan.points[::3]
    cloud = tilth.Scan(points, rings=scan.rings[::3] if rings else None, stamp=0.0)
    indices, distances = tilth.neighbors(cloud, 6)
    assert indices.shape == distances.shape == (len(points), 6)
    expected = KDTree(points).query(points, 7)[0][:, 1:]
    assert distances == pytest.approx(expected, abs=1e-4)
    assert np.linalg.norm(points[indices[:, 5]] - points, axis=1) == pytest.approx(expected[:, 5], abs=1e-4)


def test_neighbours_of_few_points():
    indices, distances = tilth.neighbors([[0, 0, 0], [3, 4, 0]], 5)
    assert indices.tolist() == [[1], [0]] and distances.tolist() == [[5], [5]]
    with pytest.raises(tilth.Error, match=r"points\[1\]: is not finite"):
        tilth.neighbors([[0, 0, 0], [np.nan, 0, 0]], 1)
    with pytest.raises(tilth.Error, match="k: is 0"):
        tilth.neighbors([[0, 0, 0]], 0)


def test_the_plain_filter_is_what_its_formula_says(scan):
    points = np.insert(scan.points[::4], 100, [[np.nan] * 3], axis=0)
    kept = tilth.remove_outliers(points, method="plain", k=8, alpha=1.5, per_range=False)
    assert kept.dtype == bool and kept.shape == (len(points),) and not kept[100]
    finite = points[np.isfinite(points).all(axis=1)]
    means = KDTree(finite).query(finite, 9)[0][:, 1:].mean(axis=1)
    expected = means <= means.mean() + 1.5 * means.std()
    assert (np.delete(kept, 100) != expected).mean() < 1e-3
    assert 0.01 < 1 - tilth.remove_outliers(scan).mean() < 0.2
    with pytest.raises(tilth.Error, match="method"):
        tilth.remove_outliers(scan, method="magic")


def test_deskewing_undoes_a_known_motion(scan):
    velocity = np.array([0.0, 0.0, 1.0, 2.0, 0.0, 0.0])
    moved = tilth.deskew(scan, velocity, 0.05)
    for i in (0, len(scan) // 2, len(scan) - 1):
        dt = float(scan.times[i]) - 0.05
        turned = Rotation.from_rotvec(dt * velocity[:3])
        a = velocity[2] * dt  # the exponential about z: the sensor drives an arc
        arc = dt * np.array([np.sinc(a / np.pi) * 2.0, (1 - np.cos(a)) / a * 2.0 if a else 0.0, 0.0])
        assert moved.points[i] == pytest.approx(turned.apply(np.array(scan.points[i])) + arc, abs=1e-4)
    assert np.array_equal(tilth.deskew(scan, np.zeros(6)).points, scan.points)
    with pytest.raises(tilth.Error, match="scan: has no times"):
        tilth.deskew(tilth.Scan(scan.points, stamp=0.0), velocity)
    with pytest.raises(tilth.Error, match=r"velocity: has the shape \(3,\), expected \(6,\)"):
        tilth.deskew(scan, velocity[:3])


def test_patches_lie_on_the_floor(still):
    patches = tilth.patches(still)
    assert 500 < len(patches) < 6000
    assert patches.covariances == pytest.approx(patches.covariances.transpose(0, 2, 1))
    assert np.linalg.norm(patches.normals[patches.flat], axis=1) == pytest.approx(1)
    assert (np.einsum("ij,ij->i", patches.normals, patches.means)[patches.flat] <= 1e-9).all()
    floor = patches.flat & (patches.normals[:, 2] > 0.99)
    assert floor.sum() > 50 and patches.means[floor, 2].std() < 0.1
    assert len(tilth.patches(np.empty((0, 3)))) == 0


def test_files_of_clouds(scan, tmp_path):
    import laspy
    from plyfile import PlyData

    cloud = np.column_stack([scan.points, scan.intensities]).astype(np.float32)
    tilth.write_pcd(tmp_path / "a.pcd", cloud)
    read = tilth.read_pcd(tmp_path / "a.pcd")
    assert read.dtype.names == ("x", "y", "z", "intensity")
    assert np.array_equal(np.column_stack([read[name] for name in read.dtype.names]), cloud)
    tilth.write_ply(tmp_path / "a.ply", read)
    assert np.array_equal(np.asarray(PlyData.read(tmp_path / "a.ply")["vertex"]["y"]), cloud[:, 1])
    assert np.array_equal(tilth.read_ply(tmp_path / "a.ply")["z"], cloud[:, 2])
    tilth.write_bin(tmp_path / "a.bin", read)
    assert np.array_equal(np.fromfile(tmp_path / "a.bin", "<f4").reshape(-1, 4), cloud)
    assert np.array_equal(tilth.read_bin(tmp_path / "a.bin")["x"], cloud[:, 0])
    tilth.write_las(tmp_path / "a.las", read)
    assert laspy.read(tmp_path / "a.las").xyz == pytest.approx(cloud[:, :3], abs=1e-4)


def test_records_keep_types_and_gaps(tmp_path):
    kinds = np.dtype({"names": list("xyzrt"), "formats": ["f4", "f4", "f4", "u2", "f8"], "offsets": [0, 4, 8, 16, 24],
                      "itemsize": 40})
    records = np.zeros(100, kinds)
    for i, name in enumerate(kinds.names):
        records[name] = np.arange(100) + i
    tilth.write_pcd(tmp_path / "a.pcd", records[::2])
    read = tilth.read_pcd(tmp_path / "a.pcd")
    for name in kinds.names:
        assert read[name].dtype == records[name].dtype and np.array_equal(read[name], records[name][::2])


def test_bad_files_are_refused_by_name(tmp_path):
    (tmp_path / "a.pcd").write_bytes(b"nothing")
    for read in (tilth.read_pcd, tilth.read_ply, tilth.read_bin):
        with pytest.raises(tilth.Error, match="a.pcd"):
            read(tmp_path / "a.pcd")
        with pytest.raises(tilth.Error, match="missing"):
            read(tmp_path / "missing")
    with pytest.raises(tilth.Error, match=r"records: has shape \(5,\)"):
        tilth.write_pcd(tmp_path / "b.pcd", np.zeros(5))
    with pytest.raises(tilth.Error, match="field name: has the type <U3"):
        tilth.write_pcd(tmp_path / "b.pcd", np.zeros(5, [("x", "f4"), ("name", "U3")]))

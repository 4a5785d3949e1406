"""The odometry and the SLAM, scan by scan: the bits of the program, whatever the arrays look like."""

import gc
import resource
import threading

import numpy as np
import pytest

import tilth


def poses_of(odometry, scans):
    return np.stack([odometry.register_scan(scan).T_world_lidar for scan in scans])


@pytest.fixture(scope="module")
def scans(drive):
    return list(tilth.open(drive))


@pytest.fixture(scope="module")
def program_trajectory(program_run):
    return tilth.read_trajectory(program_run / "trajectory.tum")


def written(trajectory, path):
    trajectory.save(path)
    return path.read_bytes()


def test_poses_are_the_programs_to_the_last_bit(scans, program_run, tmp_path):
    odometry = tilth.Odometry()
    results = [odometry.register_scan(scan) for scan in scans]
    ours = tilth.Trajectory([r.stamp for r in results], [r.T_world_lidar for r in results])
    assert len(ours) == 39
    assert written(ours, tmp_path / "ours.tum") == (program_run / "trajectory.tum").read_bytes()


@pytest.mark.parametrize("pipeline", list(tilth.pipelines()))
def test_every_pipeline_is_the_programs(pipeline, scans, drive, program, tmp_path):
    program("run", drive, "--out", tmp_path, "--quiet", "--pipeline", pipeline, "--max-scans", "8")
    odometry = tilth.Odometry(pipeline)
    results = [odometry.register_scan(scan) for scan in scans[:8]]
    ours = tilth.Trajectory([r.stamp for r in results], [r.T_world_lidar for r in results])
    assert written(ours, tmp_path / "ours.tum") == (tmp_path / "trajectory.tum").read_bytes()


def fortran(points):
    return np.asfortranarray(points)


def every_other(points):
    wide = np.full((2 * len(points), 6), np.nan)
    wide[::2, ::2] = points
    return wide[::2, ::2]


def backwards(points):
    return np.ascontiguousarray(points[::-1])[::-1]


def read_only(points):
    copy = points.copy()
    copy.flags.writeable = False
    return copy


def in_records(points):
    """Fields of 13 bytes: neither aligned nor a whole number of elements apart."""
    records = np.zeros(len(points), dtype=np.dtype([("p", "f8", 3), ("pad", "u1")]))
    records["p"] = points
    return records["p"]


def big_endian(points):
    return points.astype(">f8")


@pytest.mark.parametrize("shape", [fortran, every_other, backwards, read_only, in_records, big_endian, list])
def test_the_layout_of_an_array_does_not_matter(shape, scans):
    odometry = tilth.Odometry()
    found = [
        odometry.register_scan(shape(np.array(s.points)), s.times, s.rings, s.intensities, stamp=s.stamp).T_world_lidar
        for s in scans[:3]
    ]
    assert np.array_equal(np.stack(found), poses_of(tilth.Odometry(), scans[:3]))


def test_float32_is_read_as_what_it_is(scans):
    single = [tilth.Scan(s.points.astype(np.float32), s.times, s.rings, stamp=s.stamp) for s in scans[:5]]
    double = [
        tilth.Scan(s.points.astype(np.float32).astype(np.float64), s.times.astype(np.float64), s.rings, stamp=s.stamp)
        for s in scans[:5]
    ]
    assert np.array_equal(poses_of(tilth.Odometry(), single), poses_of(tilth.Odometry(), double))


def test_points_that_are_not_finite_are_passed_over(scans):
    odometry = tilth.Odometry()
    for s in scans[:5]:
        n = len(s)
        points = np.insert(s.points, [n // 2] * 3, [[np.nan, 0, 0], [np.inf, 1, 1], [0, 0, -np.inf]], axis=0)
        times, rings = np.insert(s.times, [n // 2] * 3, 0), np.insert(s.rings, [n // 2] * 3, 0)
        result = odometry.register_scan(points, times, rings, stamp=s.stamp)
    assert np.array_equal(result.T_world_lidar, poses_of(tilth.Odometry(), scans[:5])[-1])


def test_an_empty_scan_coasts(scans):
    odometry = tilth.Odometry()
    for s in scans[:5]:
        odometry.register_scan(s)
    result = odometry.register_scan(np.empty((0, 3)), stamp=scans[5].stamp)
    assert result.track != "tracking" and result.track_reason and result.matches == 0
    assert np.isfinite(result.T_world_lidar).all() and result.deskewed.shape == (0, 3)


def test_a_result_tells_what_it_is(scans):
    odometry = tilth.Odometry()
    for s in scans[:10]:
        result = odometry.register_scan(s)
    assert result.T_world_lidar.shape == (4, 4) and result.T_world_lidar.dtype == np.float64
    assert np.allclose(result.covariance, result.covariance.T) and np.linalg.eigvalsh(result.covariance).min() > 0
    assert result.stamp == pytest.approx(s.stamp + 0.5 * s.times.max(), abs=1e-4)
    assert result.track == "tracking" and result.converged and result.degenerate_directions == 0
    assert result.matches > 100 and result.points_in == result.outliers + len(result.filtered)
    assert result.deskewed.shape == (len(result.filtered), 3)
    assert result.deskewed == pytest.approx(
        tilth.deskew(result.filtered, result.velocity, result.stamp - s.stamp).points, abs=0.05
    )
    assert np.linalg.norm(result.velocity[3:]) < 3
    assert odometry.local_map().shape[1] == 3 and len(odometry.local_map()) > 500


BAD_SCANS = [
    ({"points": np.zeros((5, 4))}, r"points: has the shape \(5, 4\), expected \(n, 3\)"),
    ({"points": np.zeros(3)}, r"points: has the shape \(3,\)"),
    ({"points": [[0, 0, 0], [1]]}, "points: is no array"),
    ({"points": [["a", "b", "c"]]}, "points: has elements of type <U1"),
    ({"points": np.zeros((5, 3), complex)}, "points: has elements of type complex128"),
    ({"times": np.zeros(4)}, r"times: has the shape \(4,\), expected \(5,\)"),
    ({"times": np.full(5, 1.7e9)}, r"times\[0\]: is 17\d+\.0+, expected seconds since the stamp of the scan, 0 .. 10"),
    ({"times": [0, 0, -0.1, 0, 0]}, r"times\[2\]: is -0.1"),
    ({"times": [0, 0, 0, np.nan, 0]}, r"times\[3\]: is nan"),
    ({"rings": np.zeros(5)}, "rings: are no integers"),
    ({"rings": [0, 1, 2, -1, 0]}, r"rings\[3\]: is -1.0+, expected 0 .. 65535"),
    ({"rings": [0, 1, 2, 3, 70000]}, r"rings\[4\]: is 70000"),
    ({"intensities": np.zeros((5, 1))}, r"intensities: has the shape \(5, 1\)"),
    ({"stamp": float("nan")}, "stamp: is not finite"),
    ({"stamp": None}, "stamp: is missing"),
]


@pytest.mark.parametrize(("given", "message"), BAD_SCANS)
def test_bad_scans_are_refused_by_name(given, message):
    with pytest.raises(tilth.Error, match=message):
        tilth.Odometry().register_scan(**{"points": np.zeros((5, 3)), "stamp": 1.0, **given})


def test_stamps_must_ascend(scans):
    odometry = tilth.Odometry()
    odometry.register_scan(scans[1])
    for late in (scans[1], scans[0]):
        with pytest.raises(tilth.Error, match=r"stamp: is .* s, expected one after the last scan's"):
            odometry.register_scan(late)
    assert odometry.register_scan(scans[2]).track == "tracking"


def test_a_scan_has_its_own_stamp(scans):
    with pytest.raises(tilth.Error, match="points: is a Scan, which has its own"):
        tilth.Odometry().register_scan(scans[0], stamp=1.0)


def test_times_that_are_no_seconds_are_noticed(scans):
    odometry = tilth.Odometry()
    with pytest.warns(UserWarning, match="times: the last scan's reach 1 s beyond its stamp"):
        for s in scans[:2]:
            odometry.register_scan(s.points, s.times / s.times.max(), s.rings, stamp=s.stamp)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"pipeline": "no_such"}, "pipeline no_such: is not known, expected one of tilth"),
        ({"max_rang": 5}, "max_rang"),
        ({"max_range": -1}, "max_range"),
        ({"align": {"max_iterations": 0}}, r"align.max_iterations: .*1 .. 10000"),
        ({"max_range": None}, "max_range: is a NoneType, expected a bool, a number, text"),
        ({"max_range": "far"}, "max_range"),
    ],
)
def test_bad_options_are_refused_by_name(options, message):
    with pytest.raises(tilth.Error, match=message):
        tilth.Odometry(**options)


def test_options_are_those_of_the_program(program):
    assert next(iter(tilth.pipelines())) == "tilth"
    for pipeline in tilth.pipelines():
        listed = program("config", pipeline)
        for key, option in tilth.options(pipeline).items():
            assert key.rsplit(".", 1)[-1] in listed and option.meaning
    changed = tilth.options("tilth", max_range=np.float32(50), align={"max_iterations": np.int64(7)})
    assert changed["max_range"].value == "50" and changed["align.max_iterations"].value == "7"


def test_slam_is_the_programs(scans, drive, program, tmp_path):
    program("run", drive, "--out", tmp_path, "--quiet", "--loop-closure", "--set", "loop.keyframe.distance=0.3")
    slam = tilth.Slam(loop={"keyframe": {"distance": 0.3}})
    for s in scans:
        slam.register_scan(s)
    assert written(slam.trajectory(), tmp_path / "ours.tum") == (tmp_path / "trajectory.tum").read_bytes()
    rows = (tmp_path / "closures.csv").read_text().splitlines()
    assert len(slam.closures()) == len(rows) - 1 and len(slam.keyframes()) > 3
    slam.save_map(tmp_path / "ours.pcd")
    assert (tmp_path / "ours.pcd").read_bytes() == (tmp_path / "map.pcd").read_bytes()
    assert np.array_equal(slam.map()[:, 0], tilth.read_pcd(tmp_path / "map.pcd")["x"])
    assert len(slam.odometry_trajectory()) == len(scans)


def test_slam_may_be_asked_on_the_way(scans):
    slam = tilth.Slam()
    assert len(slam.trajectory()) == 0 and slam.map().shape == (0, 4) and slam.closures() == []
    for i, s in enumerate(scans[:20]):
        slam.register_scan(s)
        if i % 5 == 4:
            trajectory, points = slam.trajectory(), len(slam.map())
            assert len(trajectory) == i + 1 and points > 1000
    assert len(slam.map()) == points
    with pytest.raises(tilth.Error, match="ends in none of .pcd"):
        slam.save_map("map.obj")


def test_two_threads_with_an_odometry_each(scans):
    expected = poses_of(tilth.Odometry(), scans)
    found = {}

    def work(thread):
        found[thread] = poses_of(tilth.Odometry(), scans)

    threads = [threading.Thread(target=work, args=(i,)) for i in (0, 1)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert np.array_equal(found[0], expected) and np.array_equal(found[1], expected)


def test_two_threads_with_the_same_odometry_are_told(scan):
    odometry, refused = tilth.Odometry("improved_floam"), []
    start = threading.Barrier(4)

    def work(thread):
        start.wait()
        for i in range(40):
            try:
                odometry.register_scan(scan.points, scan.times, scan.rings, stamp=1000.0 * i + thread)
            except tilth.Error as e:
                refused.append(str(e))

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert any("is at work in another thread" in text for text in refused)


def test_nothing_leaks(scans):
    def once():
        odometry = tilth.Odometry()
        scan = tilth.Scan(scans[0].points, scans[0].times, scans[0].rings, stamp=1.0)
        result = odometry.register_scan(scan)
        return result.deskewed.sum() + result.filtered.points.sum() + scan.points.sum()

    def megabytes():
        gc.collect()
        with open("/proc/self/statm", encoding="ascii") as statm:
            return int(statm.read().split()[1]) * resource.getpagesize() / 1e6

    for _ in range(100):
        once()
    before = megabytes()
    for _ in range(1000):
        once()
    assert megabytes() - before < 20, "1,000 odometries, scans and results of about 2 MB each were made and dropped"


def test_a_sensor_that_is_mounted_tilted(scans):
    T_base_lidar = np.eye(4)
    T_base_lidar[:3] = [[0.8, 0, 0.6, 0.3], [0, 1, 0, -0.1], [-0.6, 0, 0.8, 1.2]]
    R, t = T_base_lidar[:3, :3], T_base_lidar[:3, 3]
    mounted = [
        tilth.Scan(s.points @ R.T + t, s.times, s.rings, stamp=s.stamp, T_cloud_sensor=T_base_lidar) for s in scans[:10]
    ]
    assert np.array_equal(mounted[0].T_cloud_sensor, T_base_lidar) and scans[0].T_cloud_sensor is None
    T_world_lidar = poses_of(tilth.Odometry(), scans[:10])
    expected = T_base_lidar @ T_world_lidar @ np.linalg.inv(T_base_lidar)
    assert poses_of(tilth.Odometry(), mounted) == pytest.approx(expected, abs=1e-6)
    with pytest.raises(tilth.Error, match="T_cloud_sensor: is no rigid motion"):
        tilth.Scan(scans[0].points, stamp=0.0, T_cloud_sensor=2 * T_base_lidar)


def test_views_outlive_what_they_view(scans):
    points = tilth.Scan(scans[0].points, stamp=0.0).points
    gc.collect()
    assert np.array_equal(points, scans[0].points)


def test_what_is_written_to_an_array_changes_the_scan(scans):
    scan = tilth.Scan(scans[0].points, scans[0].times, scans[0].rings, stamp=scans[0].stamp)
    scan.points[:, 2] += 1
    scan.rings[0] = 7
    assert np.array_equal(scan.points[:, 2], scans[0].points[:, 2] + 1) and scan.rings[0] == 7

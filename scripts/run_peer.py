#!/usr/bin/env python3
"""A LiDAR odometry of others, from PyPI, on a folder of scans, with the settings that its authors ship.

run_peer.py PEER --check             ends with 77 where its package is missing
run_peer.py PEER SCANS OUT [--max-scans N]

SCANS holds .pcd files (binary; x y z, and time [s] since the scan's stamp where it is known) or .bin files of KITTI, in
itself or in scans/ or velodyne/, and times.txt. OUT gets trajectory.tum and summary.json, as `tilth run` names them. One
thread. CPU time is that of the process between scan and pose; reading and the packing of points are not counted.
"""

import argparse
import importlib
import importlib.metadata
import importlib.util
import json
import os
import re
import resource
import sys
import time
from pathlib import Path

MISSING = 77
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

PCD_TYPES = {("F", "4"): "f4", ("F", "8"): "f8", ("U", "1"): "u1", ("U", "2"): "u2", ("U", "4"): "u4", ("I", "4"): "i4"}
RATE = 10.0  # [Hz] of scans without times


class KissIcp:
    """Default configuration; deskews to the end of the scan."""

    package, pose_at = "kiss-icp", 1.0

    def __init__(self):
        config = importlib.import_module("kiss_icp.config").load_config(None)
        config.registration.max_num_threads = 1
        self.odometry = importlib.import_module("kiss_icp.kiss_icp").KissICP(config)

    def register(self, points, times, _):
        self.odometry.register_frame(points, times)
        return self.odometry.last_pose


class GenzIcp:
    """Default configuration, whose deskewing is off."""

    package, pose_at = "genz-icp", 0.5

    def __init__(self):
        config = importlib.import_module("genz_icp.config").load_config(None)
        self.odometry = importlib.import_module("genz_icp.genz_icp").GenZICP(config)

    def register(self, points, times, _):
        self.odometry.register_frame(points, times)
        return self.odometry.last_pose


class SmallGicp:
    """VGICP on a voxel map as in the project's example kitti_odometry.py: 1 m voxels, 0.25 m downsampling, the newest
    motion as prediction, no deskewing."""

    package, pose_at = "small-gicp", 0.5

    def __init__(self):
        self.numpy = importlib.import_module("numpy")
        self.library = importlib.import_module("small_gicp")
        self.map = self.library.GaussianVoxelMap(1.0)
        self.map.set_lru(horizon=100, clear_cycle=10)
        self.pose = self.numpy.identity(4)
        self.motion = None

    def register(self, points, _times, _stamp):
        cloud, _ = self.library.preprocess_points(points, downsampling_resolution=0.25, num_threads=1)
        if self.motion is None:
            self.motion = self.numpy.identity(4)
        else:
            guess = self.pose @ self.motion
            pose = self.library.align(self.map, cloud, init_T_target_source=guess, num_threads=1).T_target_source
            self.motion = self.numpy.linalg.inv(self.pose) @ pose
            self.pose = pose
        self.map.insert(cloud, self.pose)
        return self.pose


class MadIcp:
    """Default parameters, 4 keyframes, ranges from 0.7 to 120 m, deskewing on, to the end of the scan."""

    package, pose_at = "mad-icp", 1.0
    min_range, max_range = 0.7, 120.0  # [m]

    def __init__(self):
        settings = importlib.import_module("mad_icp.configurations.mad_params").MADConfiguration_lut["default"]
        order = ("b_max", "rho_ker", "p_th", "b_min", "b_ratio")
        values = [settings[name] for name in order]
        library = importlib.import_module("mad_icp.src.pybind.pypeline")
        self.vector = library.VectorEigen3d
        self.odometry = library.Pipeline(RATE, True, *values, 4, 1, False)
        self.numpy = importlib.import_module("numpy")

    def register(self, points, _times, stamp):
        ranges = self.numpy.linalg.norm(points, axis=1)
        self.odometry.compute(stamp, self.vector(points[(ranges > self.min_range) & (ranges < self.max_range)]))
        return self.odometry.currentPose()


PEERS = {"kiss_icp": KissIcp, "genz_icp": GenzIcp, "mad_icp": MadIcp, "small_gicp": SmallGicp}


def read_pcd(path, numpy):
    """Points [n x 3] and times [s], or None where there are none."""
    data = path.read_bytes()
    end = data.index(b"\n", data.index(b"DATA ")) + 1
    header = dict(line.split(" ", 1) for line in data[:end].decode().splitlines() if not line.startswith("#"))
    if header["DATA"] != "binary":
        sys.exit(f"{path}: is DATA {header['DATA']}; this reads binary .pcd only")
    kinds = zip(header["TYPE"].split(), header["SIZE"].split())
    dtype = numpy.dtype([(n, PCD_TYPES[kind]) for n, kind in zip(header["FIELDS"].split(), kinds)])
    records = numpy.frombuffer(data, dtype, count=int(header["POINTS"]), offset=end)
    points = numpy.stack([records[axis] for axis in "xyz"], axis=1).astype(numpy.float64)
    times = records["time"].astype(numpy.float64) if "time" in dtype.names else None
    finite = numpy.isfinite(points).all(axis=1)
    return points[finite], times[finite] if times is not None else None


def read_scan(path, numpy):
    if path.suffix == ".pcd":
        return read_pcd(path, numpy)
    return numpy.fromfile(path, numpy.float32).reshape(-1, 4)[:, :3].astype(numpy.float64), None


def scan_files(folder):
    def natural(path):
        return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", path.name)]

    for place in (folder, folder / "scans", folder / "velodyne"):
        if not place.is_dir():
            continue
        files = [path for path in place.iterdir() if path.suffix in (".pcd", ".bin")]
        if files:
            return sorted(files, key=natural)
    sys.exit(f"{folder}: holds no .pcd and no .bin scans; peers read nothing else")


def stamps_of(folder, count):
    times = folder / "times.txt"
    stamps = [float(word) for word in times.read_text().split()] if times.exists() else []
    if stamps and len(stamps) < count:
        sys.exit(f"{times}: has {len(stamps)} times for {count} scans")
    return stamps[:count] if stamps else [i / RATE for i in range(count)]


def quaternion(rotation, numpy):
    """x y z w of a 3x3 rotation: the eigenvector of Bar-Itzhack's matrix (J. Guidance 23, 2000)."""
    r = rotation
    k = numpy.array(
        [
            [r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[2, 0] + r[0, 2], r[2, 1] - r[1, 2]],
            [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], r[2, 1] + r[1, 2], r[0, 2] - r[2, 0]],
            [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r[0, 0] + r[1, 1] + r[2, 2]],
        ]
    )
    return numpy.linalg.eigh(k)[1][:, -1]


def tum_line(stamp, pose, numpy):
    numbers = [*pose[:3, 3], *quaternion(pose[:3, :3], numpy)]
    return f"{stamp:.9f} " + " ".join(f"{number:.9g}" for number in numbers)


def summary_of(peer, version, milliseconds, numpy):
    spread = {
        "mean": float(numpy.mean(milliseconds)),
        "median": float(numpy.median(milliseconds)),
        "p99": float(numpy.percentile(milliseconds, 99)),
        "max": float(numpy.max(milliseconds)),
    }
    return {
        "version": version,
        "pipeline": peer,
        "ended": "end of input",
        "counts": {"scans": len(milliseconds), "skipped": 0},
        "milliseconds": {"register_cpu": spread},
        "peak_megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024e-6,
    }


def run(name, scans, out, max_scans):
    numpy = importlib.import_module("numpy")
    peer = PEERS[name]()
    files = scan_files(scans)
    stamps = stamps_of(scans, len(files))
    if max_scans:
        files = files[:max_scans]
    lines, milliseconds = [], []
    for path, stamp in zip(files, stamps):
        points, times = read_scan(path, numpy)
        share = times if times is not None else numpy.array([])
        duration = float(times.max()) if times is not None and len(times) else 0.0
        begin = time.process_time()
        pose = peer.register(points, share, stamp)
        milliseconds.append(1e3 * (time.process_time() - begin))
        lines.append(tum_line(stamp + peer.pose_at * duration, numpy.asarray(pose), numpy))
    out.mkdir(parents=True, exist_ok=True)
    (out / "trajectory.tum").write_text("\n".join(lines) + "\n")
    version = importlib.metadata.version(peer.package)
    (out / "summary.json").write_text(json.dumps(summary_of(name, version, milliseconds, numpy), indent=2) + "\n")


def check(name):
    peer = PEERS[name]
    if importlib.util.find_spec(peer.package.replace("-", "_")) is None:
        print(f"the Python package {peer.package} is missing")
        sys.exit(MISSING)
    print(f"{peer.package} {importlib.metadata.version(peer.package)}: {' '.join(peer.__doc__.split())}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peer", choices=sorted(PEERS), metavar="PEER", help=", ".join(sorted(PEERS)))
    parser.add_argument("scans", nargs="?", type=Path)
    parser.add_argument("out", nargs="?", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--max-scans", type=int, default=0)
    arguments = parser.parse_args()
    if arguments.check:
        check(arguments.peer)
    elif arguments.scans is None or arguments.out is None:
        parser.error("SCANS and OUT are needed")
    else:
        run(arguments.peer, arguments.scans, arguments.out, arguments.max_scans)


if __name__ == "__main__":
    main()

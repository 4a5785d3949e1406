#!/usr/bin/env python3
"""small_gicp (PyPI), one thread, on the scans of our benchmarks, beside these, in one call.

bench/beside_small_gicp.py [--tilth build/release/tilth] [--benches build/release/bench]

Neighbours and covariances of all points of one scan; registration of about 1,000 of its points to 30,000 of the fifty
scans before it, whose trees and covariances are given. Ours register as many features to the map of those scans.
Milliseconds of CPU time, the least of some repetitions of small_gicp, the mean of ours.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
import small_gicp

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from run_peer import read_pcd  # noqa: E402

SCENES = ("corridor", "plaza")
FIRST, BEFORE = 250, 50  # as in driven_scans.hpp
RINGS, MOMENTS = "along_rings/place:{0}/k:", "covariances/place:{0}/k:"
OURS = {  # benchmarks whose times add up to each figure
    "10 neighbours of all points": [RINGS + "10"],
    "20 neighbours of all points": [RINGS + "20"],
    "covariances of all points by 10 neighbours": [RINGS + "10", MOMENTS + "10"],
    "GICP": ["gicp/scene:{1}"],
    "point to point": ["point_to_point/scene:{1}"],
    "VGICP": ["gicp/scene:{1}"],
}
PLACE = {"corridor": 3, "plaza": 4}  # of search_bench


def least_ms(call, times):
    spent = []
    for _ in range(times):
        begin = time.process_time()
        call()
        spent.append(1e3 * (time.process_time() - begin))
    return min(spent)


def pose_at(truth, stamp):
    """4x4; the pose of the truth nearest in time, of which there are 200 a second."""
    _, *t, x, y, z, w = truth[numpy.argmin(abs(truth[:, 0] - stamp))]
    pose = numpy.eye(4)
    pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    pose[:3, 3] = t
    return pose


def downsampled(points, count):
    """About so many points, one a voxel."""
    low, high = 0.01, 5.0
    for _ in range(25):
        size = (low * high) ** 0.5
        cloud = small_gicp.voxelgrid_sampling(points, size)
        low, high = (size, high) if cloud.size() > count else (low, size)
    return cloud


def scans_of(tilth, scene, folder):
    subprocess.run([tilth, "simulate", scene, "--seed", "101", "--out", folder, "--duration", str(0.1 * (FIRST + 4)),
                    "--quiet"], check=True)
    truth, stamps = numpy.loadtxt(folder / "truth.tum"), numpy.loadtxt(folder / "times.txt")
    for index in range(FIRST - BEFORE, FIRST + 1):
        points, times = read_pcd(folder / "scans" / f"{index:06}.pcd", numpy)
        yield points, pose_at(truth, stamps[index] + 0.5 * times.max())


def measure(tilth, scene, folder):
    *before, (scan, T_true) = scans_of(tilth, scene, folder)
    found = {}
    for k in (10, 20):
        found[f"{k} neighbours of all points"] = least_ms(
            lambda k=k: small_gicp.KdTree(scan).batch_knn_search(scan, k + 1), 3)
    whole = small_gicp.PointCloud(scan)
    found["covariances of all points by 10 neighbours"] = least_ms(
        lambda: small_gicp.estimate_covariances(whole, small_gicp.KdTree(whole), num_neighbors=10), 3)
    near = downsampled(numpy.vstack([p @ T[:3, :3].T + T[:3, 3] for p, T in before]), 30000)
    near_tree = small_gicp.KdTree(near)
    source = downsampled(scan, 1000)
    small_gicp.estimate_covariances(near, near_tree)
    small_gicp.estimate_covariances(source)
    voxels = small_gicp.GaussianVoxelMap(1.0)
    voxels.insert(near)
    start = T_true.copy()
    start[:3, 3] += (0.02, -0.02, 0.01)
    for name, kind in (("GICP", "GICP"), ("point to point", "ICP")):
        found[name] = least_ms(lambda kind=kind: small_gicp.align(
            near, source, near_tree, init_T_target_source=start, registration_type=kind), 20)
    found["VGICP"] = least_ms(lambda: small_gicp.align(voxels, source, init_T_target_source=start), 20)
    print(f"{scene}: {len(scan)} points; {source.size()} registered to {near.size()}", flush=True)
    return found


def our_figures(benches):
    figures = {}
    for name, only in (("search_bench", "along_rings|covariances"), ("registration_bench", "gicp/|point")):
        line = [benches / name, f"--benchmark_filter={only}", "--benchmark_format=json"]
        ended = subprocess.run(line, capture_output=True, text=True, check=True)
        figures |= {bench["name"]: bench["cpu_time"] / 1e3 for bench in json.loads(ended.stdout)["benchmarks"]}
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tilth", default=str(ROOT / "build/release/tilth"))
    parser.add_argument("--benches", type=Path, default=ROOT / "build/release/bench")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        theirs = {scene: measure(arguments.tilth, scene, Path(folder) / scene) for scene in SCENES}
    ours = our_figures(arguments.benches)
    print("\n| scene | | small_gicp ms | ours ms | ratio |\n|---|---|--:|--:|--:|")
    for scene, found in theirs.items():
        for name, ms in found.items():
            own = sum(ours[bench.format(PLACE[scene], SCENES.index(scene))] for bench in OURS[name])
            print(f"| {scene} | {name} | {ms:.2f} | {own:.2f} | {ms / own:.1f} |")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Holds scans that `tilth convert CAPTURE.pcap SCANS` wrote against another decoder of the same packets.

    compare_packets.py ouster CAPTURE.pcap METADATA.json SCANS      needs ouster-sdk and scipy (PyPI)
    compare_packets.py velodyne CAPTURE.pcap MODEL SCANS            needs velodyne_decoder (PyPI); MODEL: VLP32C, VLS128, HDL64E_S3
"""
import pathlib
import sys

import numpy as np

TYPES = {("F", "4"): "f4", ("U", "1"): "u1", ("U", "2"): "u2", ("U", "4"): "u4"}

TABLES = {"VLP32C": "VLP-32C.yml", "VLS128": "Alpha Prime.yml"}


def read_pcd(path):
    head, body = path.read_bytes().split(b"DATA binary\n", 1)
    fields = {line.split()[0]: line.split()[1:] for line in head.decode().splitlines() if not line.startswith("#")}
    kinds = [TYPES[key] for key in zip(fields["TYPE"], fields["SIZE"])]
    return np.frombuffer(body, list(zip(fields["FIELDS"], kinds)), int(fields["POINTS"][0]))


def read_scans(folder):
    """Per scan: x y z intensity ring time [s] of every point."""
    stamps = np.loadtxt(folder / "times.txt", ndmin=1)
    for path, stamp in zip(sorted(folder.rglob("*.pcd")), stamps):
        cloud = read_pcd(path)
        columns = [cloud[name].astype(float) for name in ("x", "y", "z", "intensity", "ring")]
        yield np.column_stack(columns + [stamp + cloud["time"].astype(float)])


def ouster_scans(capture, metadata):
    """As read_scans, but for the ring, in the Lidar frame."""
    from ouster.sdk import open_source
    from ouster.sdk.core import XYZLut

    for frame in open_source(capture, meta=[metadata]):
        scan = frame[0]
        table, T = XYZLut(scan.sensor_info, use_extrinsics=False), np.array(scan.sensor_info.lidar_to_sensor_transform)
        parts = []
        for ranges, intensity in (("RANGE", "REFLECTIVITY"), ("RANGE2", "REFLECTIVITY2")):
            if ranges not in scan.fields:
                continue
            r = scan.field(ranges)
            points = (table(r).reshape(-1, 3) - T[:3, 3] * 1e-3) @ T[:3, :3]
            seen = (r.reshape(-1) > 0) & np.broadcast_to(scan.status & 1, r.shape).reshape(-1).astype(bool)
            times = np.broadcast_to(scan.timestamp, r.shape).reshape(-1) * 1e-9
            part = np.column_stack([points, scan.field(intensity).reshape(-1), np.zeros(len(points)), times])
            parts.append(part[seen])
        yield np.vstack(parts)


def compare_ouster(capture, metadata, folder):
    from scipy.spatial import cKDTree

    for ours, theirs in zip(read_scans(folder), ouster_scans(capture, metadata)):
        there, index = cKDTree(ours[:, :3]).query(theirs[:, :3])
        back, _ = cKDTree(theirs[:, :3]).query(ours[:, :3])
        time = (ours[index, 5] - ours[:, 5].min()) - (theirs[:, 5] - theirs[:, 5].min())
        print(f"points {len(ours)} and {len(theirs)}, farthest from the nearest {max(there.max(), back.max()):.7f} m, "
              f"times differ by up to {1e6 * abs(time).max():.2f} us, "
              f"intensities by up to {abs(ours[index, 3] - theirs[:, 3]).max():g}")


def compare_velodyne(capture, model, folder):
    import velodyne_decoder as vd

    config = vd.Config(model=getattr(vd.Model, model), min_range=0.01, max_range=1000)
    if model in TABLES:  # without the lasers' offsets along the axis, which tilth does not apply
        config.calibration = vd.Calibration.read(str(pathlib.Path(vd.__file__).parent / "calibrations" / TABLES[model]))
    if model.startswith("HDL64"):
        config.calibration = vd.hdl64e.read_calibration_from_pcap(capture)[1]
    theirs = []  # velodyne_decoder 3.1: x y z intensity time column ring kind
    for stamp, cloud in vd.read_pcap(capture, config):
        cloud = np.asarray(cloud, dtype=float)
        theirs.append(np.column_stack([cloud[:, :4], cloud[:, 6], stamp.device + cloud[:, 4]]))
    theirs, ours = np.vstack(theirs), np.vstack(list(read_scans(folder)))
    ours, theirs = (a[np.lexsort((a[:, 5], a[:, 4]))] for a in (ours, theirs))
    if len(ours) != len(theirs):
        sys.exit(f"{len(ours)} points, but theirs are {len(theirs)}")
    r, their_r = (np.linalg.norm(a[:, :3], axis=1) for a in (ours, theirs))
    up, their_up = np.degrees(np.arcsin(ours[:, 2] / r)), np.degrees(np.arcsin(theirs[:, 2] / their_r))
    turn = np.degrees(np.arctan2(ours[:, 1], ours[:, 0]) - np.arctan2(theirs[:, 1], theirs[:, 0]))
    turn = abs((turn + 180) % 360 - 180)
    time = 1e6 * (ours[:, 5] - theirs[:, 5])
    print(f"{len(ours)} points; ranges differ by up to {abs(r - their_r).max():.7f} m, elevations {abs(up - their_up).max():.6f} deg, "
          f"azimuths {np.percentile(turn, 99):.4f} deg (99 %), times {time.min():.2f} to {time.max():.2f} us")


if __name__ == "__main__":
    if len(sys.argv) != 5 or sys.argv[1] not in ("ouster", "velodyne"):
        sys.exit(__doc__)
    (compare_ouster if sys.argv[1] == "ouster" else compare_velodyne)(sys.argv[2], sys.argv[3], pathlib.Path(sys.argv[4]))

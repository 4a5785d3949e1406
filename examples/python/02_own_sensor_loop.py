"""Scans that a driver hands over as arrays, a map of their points: 02_own_sensor_loop.py MAP.pcd"""

import sys

import numpy as np

import tilth


def my_driver():
    """Stands for a sensor: stamp [s], points [m], times since the stamp [s], rings."""
    for scan in tilth.simulate("plaza_fast", duration=3, columns=900):
        yield scan.stamp, scan.points, scan.times, scan.rings


slam = tilth.Slam(max_range=80)
for stamp, points, times, rings in my_driver():
    result = slam.register_scan(points, times, rings, stamp=stamp)
    R, t = result.T_world_lidar[:3, :3], result.T_world_lidar[:3, 3]
    in_world = result.deskewed @ R.T + t
    sigma = np.sqrt(np.diag(result.covariance)[3:])
    print(f"{stamp:.2f} s: {len(in_world)} points at {t.round(3)} m, +- {1e3 * sigma.max():.1f} mm, {result.track}")
slam.save_map(sys.argv[1])
print(slam.trajectory(), "and", len(slam.map()), "points of the map")

"""A recording becomes a trajectory: 01_run_odometry.py RECORDING > trajectory.tum"""

import sys

import tilth

odometry = tilth.Odometry()
for scan in tilth.open(sys.argv[1]):
    result = odometry.register_scan(scan)
    if result.track != "tracking":
        print(f"{result.stamp:.3f} s: {result.track}: {result.track_reason}", file=sys.stderr)
    print(result.stamp, *result.T_world_lidar[:3].ravel())

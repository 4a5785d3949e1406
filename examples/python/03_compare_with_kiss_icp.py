"""Tilth and KISS-ICP (pip install kiss-icp) on the same simulated drive, judged by its truth."""

import numpy as np
from kiss_icp.config import KISSConfig
from kiss_icp.kiss_icp import KissICP

import tilth

drive = tilth.simulate("plaza_fast", seed=21, duration=6)
config = KISSConfig()
config.mapping.voxel_size = 1.0
config.data.deskew = True
tilth_odometry, kiss_icp = tilth.Odometry(), KissICP(config)
ours, theirs = [], []
for scan in drive:
    result = tilth_odometry.register_scan(scan)
    ours.append((result.stamp, result.T_world_lidar))
    kiss_icp.register_frame(scan.points, np.asarray(scan.times, dtype=np.float64))
    theirs.append((scan.stamp + float(scan.times.max()), kiss_icp.last_pose))  # of the scan's end

for name, poses in ("Tilth", ours), ("KISS-ICP", theirs):
    estimate = tilth.Trajectory([stamp for stamp, _ in poses], [pose for _, pose in poses])
    judged = tilth.evaluate(drive.truth, estimate, align="se3", interpolate=True)
    print(f"{name}: APE {judged.ape.translation.rmse:.4f} m RMSE, {judged.ape.translation.max:.4f} m at most")

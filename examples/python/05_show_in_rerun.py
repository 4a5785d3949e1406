"""A run to be looked at in Rerun (pip install rerun-sdk): 05_show_in_rerun.py RECORDING OUT.rrd; then rerun OUT.rrd"""

import sys

import rerun as rr

import tilth

rr.init("tilth")
rr.save(sys.argv[2])
rr.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
slam = tilth.Slam()
for scan in tilth.open(sys.argv[1]):
    result = slam.register_scan(scan)
    T_world_lidar = result.T_world_lidar
    rr.set_time("stamp", timestamp=result.stamp)
    rr.log("world/lidar", rr.Transform3D(translation=T_world_lidar[:3, 3], mat3x3=T_world_lidar[:3, :3]))
    rr.log("world/lidar/scan", rr.Points3D(result.deskewed, radii=0.02))
    rr.log("track", rr.TextLog(f"{result.track} {result.track_reason}"))
rr.log("world/way", rr.LineStrips3D([slam.trajectory().positions]), static=True)
rr.log("world/map", rr.Points3D(slam.map()[:, :3], radii=0.01), static=True)
print(slam.trajectory())

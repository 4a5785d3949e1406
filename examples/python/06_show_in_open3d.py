"""Map and way in Open3D (pip install open3d): 06_show_in_open3d.py RECORDING [FOLDER to write instead of a window]"""

import sys
from pathlib import Path

import numpy as np
import open3d as o3d

import tilth

run = tilth.run(sys.argv[1], loop_closure=True)
cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(run.map[:, :3]))
height = np.clip((run.map[:, 2] - run.map[:, 2].min()) / 3.0, 0, 1)
cloud.colors = o3d.utility.Vector3dVector(np.column_stack([height, 0.5 * np.ones_like(height), 1 - height]))
steps = [(i, i + 1) for i in range(len(run.trajectory) - 1)]
way = o3d.geometry.LineSet(
    o3d.utility.Vector3dVector(run.trajectory.positions), o3d.utility.Vector2iVector(np.array(steps, dtype=np.int32))
)
if len(sys.argv) > 2:
    o3d.io.write_point_cloud(str(Path(sys.argv[2]) / "map.ply"), cloud)
    o3d.io.write_line_set(str(Path(sys.argv[2]) / "way.ply"), way)
else:
    o3d.visualization.draw_geometries([cloud, way])
print(cloud, "and", way)

"""Where a simulated LiDAR truly was, and how far from there messages of /tf (ROS 1 or ROS 2) have it in a map."""

import numpy as np


def seconds(stamp):
    return stamp.secs + 1e-9 * stamp.nsecs if hasattr(stamp, "secs") else stamp.sec + 1e-9 * stamp.nanosec


def matrix(position, quaternion):
    """4x4 of x, y, z and qx, qy, qz, qw."""
    x, y, z, w = quaternion
    pose = np.eye(4)
    pose[:3, :3] += 2 * np.array(
        [
            [-y * y - z * z, x * y - z * w, x * z + y * w],
            [x * y + z * w, -x * x - z * z, y * z - x * w],
            [x * z - y * w, y * z + x * w, -x * x - y * y],
        ]
    )
    pose[:3, 3] = position
    return pose


def matrix_of(transform):
    p, q = transform.translation, transform.rotation
    return matrix((p.x, p.y, p.z), (q.x, q.y, q.z, q.w))


class Truth:
    """Poses of the LiDAR in the simulated world, every 5 ms; its truth.tum lies in `folder`."""

    def __init__(self, folder):
        self.rows = np.loadtxt(folder / "truth.tum")

    def __call__(self, stamp):
        stamps = self.rows[:, 0]
        position = [np.interp(stamp, stamps, self.rows[:, axis]) for axis in (1, 2, 3)]
        return matrix(position, self.rows[np.argmin(np.abs(stamps - stamp)), 4:])


def errors_in_map(heard, saved, mapped, driven):
    """[m] of each message that says where the LiDAR is in the map of the folder `saved`, which begins where the drive
    in `mapped` did at its first pose; the one that was heard is in `driven`."""
    world_map = Truth(mapped)(np.loadtxt(saved / "trajectory.tum")[0, 0])
    truth, errors = Truth(driven), []
    for message in heard:
        if len(message.transforms) < 2:
            continue
        map_odom, odom_lidar = (matrix_of(t.transform) for t in message.transforms)
        expected = np.linalg.inv(world_map) @ truth(seconds(message.transforms[1].header.stamp))
        errors.append(np.linalg.norm((map_odom @ odom_lidar - expected)[:3, 3]))
    return errors

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


class MapTruth:
    """T_map_lidar of the drive in the folder `driven`, in the map of the folder `saved`, which begins where the drive in
    `mapped` did at its first pose."""

    def __init__(self, saved, mapped, driven):
        self.world_map = Truth(mapped)(np.loadtxt(saved / "trajectory.tum")[0, 0])
        self.driven = Truth(driven)

    def __call__(self, stamp):
        return np.linalg.inv(self.world_map) @ self.driven(stamp)


def errors_in_map(heard, truth):
    """[m] from that truth of each message of /tf that says where the LiDAR is in the map."""
    errors = []
    for message in heard:
        if len(message.transforms) < 2:
            continue
        map_odom, odom_lidar = (matrix_of(t.transform) for t in message.transforms)
        expected = truth(seconds(message.transforms[1].header.stamp))
        errors.append(np.linalg.norm((map_odom @ odom_lidar - expected)[:3, 3]))
    return errors


def assert_told_where_known(poses, heard):
    """Each of `poses` (PoseWithCovarianceStamped) is what the message of /tf of its stamp says; both come together."""
    known = {seconds(m.transforms[1].header.stamp): m for m in heard if len(m.transforms) == 2}
    assert [seconds(pose.header.stamp) for pose in poses] == list(known)
    for pose in poses:
        map_odom, odom_lidar = (matrix_of(t.transform) for t in known[seconds(pose.header.stamp)].transforms)
        at = pose.pose.pose.position
        assert np.allclose((map_odom @ odom_lidar)[:3, 3], (at.x, at.y, at.z), atol=1e-6)
        covariance = np.reshape(pose.pose.covariance, (6, 6))
        assert pose.header.frame_id == "map" and np.all(np.linalg.eigvalsh(covariance) > 0)


def fill_guess(guess, T_map_lidar, offset, frame="map"):
    """Of a PoseWithCovarianceStamped: that pose as RViz sends it, on the ground, `offset` [m] beside."""
    guess.header.frame_id = frame
    guess.pose.pose.position.x, guess.pose.pose.position.y = (float(v) for v in T_map_lidar[:2, 3] + offset)
    yaw = np.arctan2(T_map_lidar[1, 0], T_map_lidar[0, 0])
    guess.pose.pose.orientation.z, guess.pose.pose.orientation.w = float(np.sin(yaw / 2)), float(np.cos(yaw / 2))
    return guess

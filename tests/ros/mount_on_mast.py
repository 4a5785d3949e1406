"""A mount as a robot description tells it: base_link -> mast -> lidar, in transforms of ROS 1 or ROS 2."""

import math


def quaternion(roll, pitch, yaw):
    """x, y, z, w of degrees about the fixed axes x, y, z in this order."""
    halves = [math.radians(angle) / 2 for angle in (roll, pitch, yaw)]
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(half), math.cos(half)) for half in halves)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def mount_on_mast(kind, mount):
    """Two of `kind` (TransformStamped), by "x,y,z,roll,pitch,yaw" [m, deg]."""
    x, y, z, *angles = (float(number) for number in mount.split(","))
    mast, lidar = kind(), kind()
    mast.header.frame_id, mast.child_frame_id = "base_link", "mast"
    t = mast.transform.translation
    t.x, t.y, t.z = x, y, z
    mast.transform.rotation.w = 1.0
    lidar.header.frame_id, lidar.child_frame_id = "mast", "lidar"
    q = lidar.transform.rotation
    q.x, q.y, q.z, q.w = quaternion(*angles)
    return [mast, lidar]

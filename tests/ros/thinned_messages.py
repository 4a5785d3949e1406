"""The last scan, map and path of a node with scan_points 3000 and map_points 9000, in messages of ROS 1 or ROS 2."""

NAMES = ("odometry", "map", "path", "scan")


def stamp_of(message):
    """[s], [ns]."""
    stamp = message.header.stamp
    return (stamp.secs, stamp.nsecs) if hasattr(stamp, "secs") else (stamp.sec, stamp.nanosec)


def is_last(name, heard, odometry):
    """Whether the newest of `heard` is of the scan of `odometry`."""
    return bool(heard) and stamp_of(heard[-1].poses[-1] if name == "path" else heard[-1]) == stamp_of(odometry)


def assert_thinned(scan, whole, way):
    assert (scan.header.frame_id, scan.width) == ("lidar", 3000)
    assert [field.name for field in scan.fields] == ["x", "y", "z", "intensity", "ring"]
    assert len(scan.data) == scan.row_step == scan.width * scan.point_step
    assert whole.header.frame_id == "map" and 4000 < whole.width <= 9000
    assert way.header.frame_id == "map"

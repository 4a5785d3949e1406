"""Real recordings by Python and by the program: the same bits. Skipped by name where one is not at hand."""

import itertools
import os
import subprocess
from pathlib import Path

import pytest

import tilth
from tilth.program import PROGRAM

ROOT = Path(__file__).resolve().parent.parent.parent
DATA = Path(os.environ.get("TILTH_DATA") or ROOT / "../shared/data")
RECORDINGS = ("vlp16-corridor", "vlp32-front-driving", "rs16-static-room", "xt32-hilti14", "robosense128-no-ring")
SCANS = 6


def from_arrays(scan):
    return tilth.Scan(
        scan.points, scan.times, scan.rings, scan.intensities, stamp=scan.stamp, T_cloud_sensor=scan.T_cloud_sensor
    )


@pytest.mark.parametrize("name", RECORDINGS)
def test_poses_are_the_programs(name, tmp_path):
    folder = DATA / name
    if not folder.exists():
        pytest.skip(f"no recording {folder} (set TILTH_DATA)")
    command = [PROGRAM, "run", folder, "--out", tmp_path, "--quiet", "--max-scans", str(SCANS)]
    assert subprocess.run(command, check=False).returncode in (0, 3), "3: the track was lost"
    theirs = (tmp_path / "trajectory.tum").read_bytes()
    for made in (lambda scan: scan, from_arrays):
        odometry = tilth.Odometry()
        results = [odometry.register_scan(made(scan)) for scan in itertools.islice(tilth.open(folder), SCANS)]
        assert len(results) == SCANS
        tilth.Trajectory([r.stamp for r in results], [r.T_world_lidar for r in results]).save(tmp_path / "ours.tum")
        assert (tmp_path / "ours.tum").read_bytes() == theirs

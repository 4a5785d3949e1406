"""Poses over time."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tilth import _tilth
from tilth._tilth import Error


class Trajectory:
    """Stamps [s] that ascend, (n,), and poses T_world_lidar, (n, 4, 4).

    ``len()``, slices and iteration over (stamp, pose) work as those of a list. Raises tilth.Error naming the entry
    where a pose is no rigid motion or a stamp is not after the one before.
    """

    def __init__(self, stamps: ArrayLike, poses: ArrayLike) -> None:
        checked = _tilth.JudgedPoses.of(stamps, poses, "trajectory")
        self.stamps: NDArray[np.float64]
        self.poses: NDArray[np.float64]
        self.stamps, self.poses = checked.trajectory()

    @property
    def positions(self) -> NDArray[np.float64]:
        """(n, 3) [m] of the LiDAR in the world frame."""
        return self.poses[:, :3, 3]

    @property
    def length(self) -> float:
        """[m] sum of the distances between consecutive poses."""
        return float(np.linalg.norm(np.diff(self.positions, axis=0), axis=1).sum())

    def save(self, path: str | os.PathLike[str], format: str = "tum") -> None:
        """Writes "tum" (stamp x y z qx qy qz qw a line) or "kitti" (the upper 3 x 4 of each pose)."""
        write = {"tum": _tilth.write_tum, "kitti": _tilth.write_kitti}.get(format)
        if write is None:
            raise Error(f"format: is {format!r}, expected 'tum' or 'kitti'")
        write(os.fspath(path), self.stamps, self.poses)

    def to_evo(self) -> Any:
        """The same as a PoseTrajectory3D of evo, which must be installed."""
        from evo.core.trajectory import PoseTrajectory3D  # type: ignore[import-untyped]

        return PoseTrajectory3D(poses_se3=list(self.poses), timestamps=self.stamps.copy())

    @classmethod
    def from_evo(cls, trajectory: Any) -> "Trajectory":
        """A PoseTrajectory3D of evo."""
        return cls(trajectory.timestamps, np.stack(trajectory.poses_se3))

    def __len__(self) -> int:
        return len(self.stamps)

    def __iter__(self) -> Iterator[tuple[float, NDArray[np.float64]]]:
        for stamp, pose in zip(self.stamps, self.poses, strict=True):
            yield float(stamp), pose

    def __getitem__(self, index: slice) -> "Trajectory":
        return Trajectory(self.stamps[index], self.poses[index])

    def __repr__(self) -> str:
        if len(self) == 0:
            return "Trajectory(no poses)"
        return f"Trajectory({len(self)} poses, {self.stamps[-1] - self.stamps[0]:.1f} s, {self.length:.1f} m)"


def read_trajectory(path: str | os.PathLike[str]) -> Trajectory:
    """A file of poses: TUM, KITTI, or a table whose header names its columns.

    Of a file without stamps, the stamp is the pose's number. Raises tilth.Error naming file, line and field.
    """
    return Trajectory(*_tilth.JudgedPoses.read(str(Path(path)), "none").trajectory())

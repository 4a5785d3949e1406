"""A pipeline that is fed scan by scan, with loop closure or without."""

import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._tilth import Error, Result, Scan
from tilth.files import write_cloud
from tilth.trajectory import Trajectory

Prior = Union[Trajectory, str, "os.PathLike[str]", None]


@dataclass(frozen=True)
class Option:
    """An option of a pipeline: its value in force, its unit, what is allowed and what it means."""

    key: str
    value: str
    unit: str
    allowed: str
    meaning: str


def pipelines() -> dict[str, str]:
    """Every pipeline by its name, the default one first, with what it is."""
    return dict(_tilth.pipelines())


def options(pipeline: str = "tilth", **values: OptionValue) -> dict[str, Option]:
    """Every option of a pipeline by its key, with `values` set. Raises tilth.Error as Odometry does."""
    return {row[0]: Option(*row) for row in _tilth.describe_odometry(pipeline, option_values(values))}


class Odometry:
    """A pipeline that turns scan after scan into poses.

    pipeline: one of ``tilth.pipelines()``.
    options: those of ``tilth.options(pipeline)``, of which dotted keys are given as mappings:
        ``Odometry(max_range=50, align={"max_iterations": 30})``.
    prior: trajectory of the LiDAR by another source (wheels, an IMU, another odometry), by the clock of the scans, or
        its file: a help where scans tell little. None: the scans alone.

    The bits of the results do not depend on the number of threads, and are those of the program. One thread at a time
    may use an Odometry; other threads of Python run while it works. Raises tilth.Error on an unknown pipeline or option
    and on a value out of its bounds.
    """

    def __init__(self, pipeline: str = "tilth", *, prior: Prior = None, **options: OptionValue) -> None:
        self._registrar: _tilth.Odometry = _tilth.Odometry(pipeline, option_values(options), _motion_of(prior))
        self._check = _TimesCheck()

    def register_scan(
        self,
        points: Scan | ArrayLike,
        times: ArrayLike | None = None,
        rings: ArrayLike | None = None,
        intensities: ArrayLike | None = None,
        *,
        stamp: float | None = None,
    ) -> Result:
        """Registers the next scan: a tilth.Scan, or the arrays that one is made of.

        points: (n, 3) [m] in the LiDAR frame; points that are not finite are passed over.
        times: (n,) [s] since `stamp`; with them the motion within the scan is undone.
        rings: (n,) integers, 0 the lowest beam.
        intensities: (n,).
        stamp: [s] of the first point, after that of the scan before.

        A scan that cannot be registered gets a predicted pose and says so in ``track``. Raises tilth.Error naming the
        argument, its entry and its bound.
        """
        scan = as_scan(points, times, rings, intensities, stamp)
        if scan is not points:
            self._check.look_at(scan)
        return self._registrar.register_scan(scan)

    def local_map(self) -> NDArray[np.float64]:
        """(n, 3) [m] points, or means of Gaussians, in the world frame: the next scan will be registered to them."""
        return self._registrar.local_map()


class Slam(Odometry):
    """An odometry that closes loops: what has been passed is corrected by what is found later.

    loop: options of loop closure (docs/loop_closure.md), without their ``loop.``: ``loop={"detect": {"radius": 8}}``.
    map_voxel: [m] edge of the map's voxels, each of which keeps one point; None: as the program does.
    pipeline, prior, options: as those of Odometry.

    ``register_scan`` gives odometry's pose. ``trajectory()``, ``closures()`` and ``map()`` optimise with all closures
    of the scans so far; called after the last scan they are those of ``tilth run --loop-closure``.
    """

    def __init__(
        self,
        pipeline: str = "tilth",
        *,
        loop: Mapping[str, OptionValue] | None = None,
        map_voxel: float | None = None,
        prior: Prior = None,
        **options: OptionValue,
    ) -> None:
        super().__init__(pipeline, prior=prior, **options)
        map_values: dict[str, OptionValue] = {} if map_voxel is None else {"map_voxel": map_voxel}
        loop_and_map = option_values({"loop": loop or {}}), option_values(map_values)
        self._slam = _tilth.Slam(pipeline, option_values(options), _motion_of(prior), loop_and_map)
        self._registrar = self._slam

    def trajectory(self) -> Trajectory:
        """Every registered scan, corrected by the closures."""
        return Trajectory(*self._slam.trajectory())

    def odometry_trajectory(self) -> Trajectory:
        """Every registered scan by odometry alone."""
        return Trajectory(*self._slam.odometry_trajectory())

    def keyframes(self) -> list[int]:
        """The numbers of the registered scans that are keyframes."""
        return self._slam.keyframes()

    def closures(self) -> list[dict[str, Any]]:
        """A dict each pair of keyframes that was looked at: scans, T_from_to, verdict ... (docs/loop_closure.md)."""
        return self._slam.closures()

    def map(self) -> NDArray[np.float32]:
        """(n, 4) x y z [m] intensity of the corrected map, in the world frame."""
        return self._slam.map()

    def save_map(self, path: str | os.PathLike[str]) -> None:
        """Writes the corrected map as .pcd, .ply or .las; else as a folder that tilth.Localizer opens, as the program's
        ``--save-map`` does.

        Raises tilth.Error where it cannot be written, and of a folder where the track was lost on the way and what came
        after is joined to nothing.
        """
        if os.path.splitext(path)[1]:
            write_cloud(path, self._slam.map_records())
        else:
            self._slam.save_places(os.fspath(path))


def as_scan(
    points: Scan | ArrayLike,
    times: ArrayLike | None = None,
    rings: ArrayLike | None = None,
    intensities: ArrayLike | None = None,
    stamp: float | None = None,
) -> Scan:
    """`points` where it is a Scan, else one of the arrays. Raises tilth.Error where both are given, or no stamp."""
    if isinstance(points, Scan):
        if any(given is not None for given in (times, rings, intensities, stamp)):
            raise Error("points: is a Scan, which has its own times, rings, intensities and stamp")
        return points
    if stamp is None:
        raise Error("stamp: is missing: the time [s] of the scan's first point")
    return Scan(points, times, rings, intensities, stamp=stamp)


def _motion_of(prior: Prior) -> _tilth.ExternalMotion | None:
    if prior is None:
        return None
    if isinstance(prior, Trajectory):
        return _tilth.ExternalMotion.of(prior.stamps, prior.poses)
    return _tilth.ExternalMotion.read(os.fspath(prior))


class _TimesCheck:
    """Notices times that are no seconds: scans that would last far longer than it takes until the next one."""

    def __init__(self) -> None:
        self._stamp: float | None = None
        self._duration = 0.0

    def look_at(self, scan: Scan) -> None:
        if self._stamp is not None and self._duration > 2 * (scan.stamp - self._stamp) > 0:
            warnings.warn(
                f"times: the last scan's reach {self._duration:.3g} s beyond its stamp, though the next stamp follows "
                f"{scan.stamp - self._stamp:.3g} s later; they must be seconds, or the poses will be wrong",
                stacklevel=3,
            )
        self._stamp = scan.stamp
        self._duration = float(scan.times.max()) if scan.times is not None and len(scan) else 0.0

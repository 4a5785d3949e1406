"""Single stages of the pipelines, for pipelines of one's own."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._tilth import Error, Registration, Scan

Cloud = Scan | ArrayLike


@dataclass(frozen=True)
class Patches:
    """Pieces of surface (surfels), one entry a patch."""

    means: NDArray[np.float64]
    """(n, 3) [m] of the points of one beam"""
    covariances: NDArray[np.float64]
    """(n, 3, 3) [m^2] of these and of those of the beams beside"""
    normals: NDArray[np.float64]
    """(n, 3) unit vectors towards the sensor; of least extent where not flat"""
    times: NDArray[np.float32]
    """(n,) [s] since the stamp of the scan"""
    thickness: NDArray[np.float32]
    """(n,) [m^2] variance along the normal"""
    points: NDArray[np.uint16]
    """(n,) of which `means` are the means"""
    rings: NDArray[np.uint16]
    """(n,) 0 the lowest beam"""
    flat: NDArray[np.bool_]
    """(n,) a piece of a plane; else a pole, an edge, a bush"""

    def __len__(self) -> int:
        return len(self.means)


def register(
    source: Cloud, target: Cloud, T_init: ArrayLike | None = None, **options: OptionValue
) -> Registration:
    """Registers one cloud to another: GICP of patches with voxels, from large voxels to small ones.

    source, target: Scans, or (n, 3) [m]; each counts as measured at once from the origin of its frame (deskew it
        before). With rings it is faster and more exact.
    T_init: (4, 4) guess of T_target_source, which is found within about 2 m and 20 degrees of it (`coarse_voxel`).
        None: whichever way the source is turned about z and some metres from the target, where both show enough of the
        same; either frame's z is upwards to 45 degrees where the cloud shows a floor.
    options: ``coarse_voxel=4.0`` [m], ``align={"max_iterations": 100}`` ...; without a guess also `find`, as
        ``find={"search": {"off_way": 12}}`` [m], and `check`.

    Look at ``answer``, ``converged`` and ``degenerate_directions`` before you trust it: without a guess,
    ``T_target_source`` is NaN where nothing was found, or several places fit alike. Raises tilth.Error on a bad shape,
    guess or option.
    """
    return _tilth.register(_scan(source), _scan(target), T_init, option_values(options))


def remove_outliers(cloud: Cloud, **options: OptionValue) -> NDArray[np.bool_]:
    """(n,) True for the points to keep; points that are not finite are never kept.

    options: ``method`` ("support": by the beams beside a point, or without rings by company in a cell; "weighted",
        "plain": by the distances of ``k`` neighbours; "none"), ``alpha``, ``noise`` [m] ...
    """
    return _tilth.inliers(_scan(cloud), option_values(options))


def deskew(scan: Scan, velocity: ArrayLike, reference_time: float | None = None) -> Scan:
    """The scan as a sensor moving at `velocity` would have seen it all at once.

    velocity: (6,) [rad/s, m/s], rotation first, in the LiDAR's frame.
    reference_time: [s] since the stamp; None: the middle of the scan.

    Raises tilth.Error where the scan has no times.
    """
    if reference_time is None:
        reference_time = 0.5 * float(scan.times.max()) if scan.times is not None and len(scan) else 0.0
    return _tilth.deskew(scan, velocity, float(reference_time))


def neighbors(cloud: Cloud, k: int) -> tuple[NDArray[np.uint32], NDArray[np.float32]]:
    """The exact k nearest neighbours of every point, itself excluded: indices and distances [m], (n, k), ascending.

    k is smaller in the result where the cloud has fewer than k + 1 points. With rings no tree is built. Raises
    tilth.Error where a point is not finite.
    """
    if k < 1:
        raise Error(f"k: is {k}, expected 1 or more")
    return _tilth.neighbors(_scan(cloud), k)


def patches(cloud: Cloud, **options: OptionValue) -> Patches:
    """The patches of surface of a scan, ring by ring; without rings from neighbourhoods.

    options: ``max_thickness`` [m], ``segments={"length": 0.3}`` ... (docs/method.md, 2)
    """
    return Patches(**_tilth.patches(_scan(cloud), option_values(options)))


def _scan(cloud: Cloud) -> Scan:
    return cloud if isinstance(cloud, Scan) else Scan(cloud, stamp=0.0)

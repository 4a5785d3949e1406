"""A saved map in which scan after scan is found."""

import os
from collections.abc import Mapping

from numpy.typing import ArrayLike

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._tilth import Located, Scan
from tilth.odometry import as_scan


class Localizer:
    """Finds a LiDAR in a saved map without being told where it is, and follows it there.

    map: folder that ``tilth run --save-map``, ``tilth map import`` or ``Slam.save_map`` made.
    T_map_lidar: (4, 4) about where the first scan is taken; None: anywhere in the map.
    localize: options of localisation (docs/localization.md) without their ``localize.``: ``{"min_fit": 0.4}``.
    pipeline, options: the odometry that carries on from scan to scan, as those of tilth.Odometry.

    One thread at a time may use it. Raises tilth.Error where the map cannot be read and where an option is wrong.
    """

    def __init__(
        self,
        map: str | os.PathLike[str],
        T_map_lidar: ArrayLike | None = None,
        *,
        pipeline: str = "tilth",
        localize: Mapping[str, OptionValue] | None = None,
        **options: OptionValue,
    ) -> None:
        self._localizer = _tilth.Localizer(
            os.fspath(map), pipeline, option_values(options), option_values({"localize": localize or {}}), T_map_lidar
        )

    def add(
        self,
        points: Scan | ArrayLike,
        times: ArrayLike | None = None,
        rings: ArrayLike | None = None,
        intensities: ArrayLike | None = None,
        *,
        stamp: float | None = None,
    ) -> Located:
        """Where the next scan was taken: a tilth.Scan, or the arrays of one, as Odometry.register_scan takes them.

        What is not known is said in ``state``, and ``T_map_lidar`` is None then. Raises tilth.Error naming the argument,
        its entry and its bound, and where the scan cannot be used at all: the next one may.
        """
        return self._localizer.add(as_scan(points, times, rings, intensities, stamp))

    def forget(self) -> None:
        """Forgets where it is, and the scans so far."""
        self._localizer.forget()

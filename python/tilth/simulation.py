"""Recordings with exact truth, made from a scene (docs/simulation.md)."""

import os
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from tilth import _tilth, program
from tilth._options import OptionValue, option_values
from tilth._tilth import Scan
from tilth.trajectory import Trajectory


class Simulation:
    """The scans of a simulated drive, each made as it is asked for; the same options give the same bits."""

    def __init__(self, scene: str, values: dict[str, str]) -> None:
        self._simulator = _tilth.Simulator(scene, values)
        self.scene = scene

    @property
    def truth(self) -> Trajectory:
        """True poses T_world_lidar at 200 Hz."""
        return Trajectory(*self._simulator.truth())

    @property
    def warnings(self) -> list[str]:
        """What a world file names that was left out."""
        return self._simulator.warnings()

    def labels(self, index: int) -> NDArray[np.uint8]:
        """(n,) of scan `index`: 0 surface, 1 outlier, 2 mixed, 3 ghost, 4 moving; plus 128 on an edge."""
        return self._simulator.scan(index)[1]

    def __len__(self) -> int:
        return self._simulator.size()

    def __getitem__(self, index: int) -> Scan:
        return self._simulator.scan(index + len(self) if index < 0 else index)[0]

    def __iter__(self) -> Iterator[Scan]:
        for index in range(len(self)):
            yield self[index]

    def __repr__(self) -> str:
        return f"Simulation({self.scene!r}, {len(self)} scans)"


def simulate(
    scene: str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    *,
    format: str = "pcd",
    **options: OptionValue,
) -> Simulation:
    """A drive through a scene, or through a Gazebo world file, with exact truth.

    out: folder to write the recording to, as ``tilth simulate`` does, with truth.tum; None: none.
    format: of that recording: pcd, kitti, bag or pcap.
    options: those of ``tilth simulate --set``: ``seed=3, duration=20, sensor="hdl32", noise=0.03``.

    Raises tilth.Error on an unknown scene, format or option and on a value out of its bounds.
    """
    values = option_values(options)
    simulation = Simulation(os.fspath(scene), values)
    if out is not None:
        settings = [text for key, value in values.items() for text in ("--set", f"{key}={value}")]
        program.call(["simulate", os.fspath(scene), "--out", out, "--format", format, "--quiet", *settings])
    return simulation

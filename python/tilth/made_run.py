"""What came of a whole recording."""

import json
import os
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tilth import _tilth
from tilth.evaluation import Evaluation
from tilth.files import write_cloud
from tilth.recording import Skipped
from tilth.trajectory import Trajectory


class TrackLostWarning(UserWarning):
    """A run lost its way: poses after that are right among themselves at best."""


class Run:
    """What came of ``tilth.run``."""

    def __init__(self, outcome: _tilth.RunOutcome, out: str) -> None:
        self._outcome = outcome
        self.out = out

    @cached_property
    def trajectory(self) -> Trajectory:
        """Every registered scan, corrected where loops were closed."""
        return Trajectory(*self._outcome.trajectory())

    @cached_property
    def odometry_trajectory(self) -> Trajectory:
        """Every registered scan by odometry alone."""
        return Trajectory(*self._outcome.odometry())

    @cached_property
    def map(self) -> NDArray[np.float32]:
        """(n, 4) x y z [m] intensity, in the world frame."""
        return self._outcome.map()

    @cached_property
    def scans(self) -> dict[str, NDArray[Any]]:
        """What became of each scan, by column (docs/outputs.md): stamp [s], track, matches, register_ms [ms] ..."""
        columns = self._outcome.scans()
        return {name: np.asarray(column) for name, column in columns.items()}

    @property
    def closures(self) -> list[dict[str, Any]]:
        """One dict a pair of keyframes that was looked at (docs/loop_closure.md)."""
        return self._outcome.closures()

    @property
    def evaluation(self) -> Evaluation | None:
        """Of the trajectory by the truth, first poses made equal; None without truth."""
        found = self._outcome.evaluation()
        return None if found is None else Evaluation(found)

    @property
    def lost(self) -> str:
        """Where the track was lost and why; '' where it never was."""
        return self._outcome.loss()

    @property
    def ended(self) -> str:
        """Why no more scans were registered: "end of input" ..."""
        return self._outcome.ended()

    @property
    def decisions(self) -> list[str]:
        """How the recording was understood."""
        return self._outcome.decisions()

    @property
    def notices(self) -> list[str]:
        """What was noticed on the way, and what may go wrong with such a recording."""
        return self._outcome.notices()

    @property
    def skipped(self) -> list[Skipped]:
        """Records that have no pose, and why."""
        return [Skipped(*row) for row in self._outcome.skipped()]

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Every figure of summary.json (docs/outputs.md)."""
        loaded: dict[str, Any] = json.loads(self._outcome.summary())
        return loaded

    def save_map(self, path: str | os.PathLike[str]) -> None:
        """Writes the map as .pcd, .ply or .las."""
        write_cloud(path, self._outcome.map_records())

    def __repr__(self) -> str:
        return f"Run({self.trajectory!r}, {self.ended}{', LOST ITS WAY' if self.lost else ''})"

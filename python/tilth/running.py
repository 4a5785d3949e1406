"""A whole recording at once, as ``tilth run`` does it."""

import json
import os
import warnings
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._progress import Progress, progress_of
from tilth._tilth import Error
from tilth.evaluation import Evaluation
from tilth.files import write_cloud
from tilth.recording import Recording, Skipped
from tilth.trajectory import Trajectory

MAP_OPTIONS = ("map_voxel", "map_max_points")
REPORT_OPTIONS = ("report_points",)


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


def run(
    source: Recording | str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    *,
    pipeline: str = "tilth",
    loop_closure: bool = False,
    loop: Mapping[str, OptionValue] | None = None,
    outputs: Mapping[str, OptionValue] | None = None,
    beams: str | os.PathLike[str] = "",
    learn_beams: bool = False,
    base_from_lidar: str = "",
    truth: str | os.PathLike[str] = "",
    calibration: str | os.PathLike[str] = "",
    max_scans: int = 0,
    threads: int = 0,
    strict: bool = False,
    progress: bool | Callable[[int, int | None], object] = False,
    **options: OptionValue,
) -> Run:
    """Turns a recording into a trajectory and a map: the bits of ``tilth run``, and with `out` its files.

    source: a Recording, or what ``tilth.open`` takes.
    out: folder of trajectory.tum, map.pcd, report.html ... (docs/outputs.md); None: no files.
    pipeline, options: as those of tilth.Odometry.
    loop_closure, loop: as tilth.Slam does.
    outputs: of the map, the files and the report, as the flags of ``tilth run``: ``{"map_voxel": 0.05, "mcap": True}``.
    beams: file of the errors of the sensor's beams, which are taken out of every scan.
    learn_beams: errors of beams are taken out of the scans from where the drive has shown them.
    base_from_lidar: how the LiDAR is mounted, "x,y,z,roll,pitch,yaw" [m, deg]: poses are then of the robot's base_link.
    truth, calibration: file of true poses to judge the run by, and KITTI's calibration.
    max_scans: stop after so many; 0: all. threads: 0: as many as there are processors.
    strict: a record that cannot be used ends the run.
    progress: True: a bar where tqdm is installed; or a function of the scans so far and of all (None where not known).

    A run that lost its way warns with TrackLostWarning; see ``Run.lost``. Raises tilth.Error on what is wrong before
    the first scan, where no scan can be used, and where a file cannot be written. Ctrl-C, and what `progress` raises,
    end the run; they are raised once the files of what was registered so far are written.
    """
    request = _request(source, options)
    request.out = "" if out is None else os.fspath(out)
    request.pipeline, request.loop_closure, request.strict = pipeline, loop_closure, strict
    request.learn_beams, request.base_from_lidar = learn_beams, base_from_lidar
    request.loop = option_values({"loop": loop or {}})
    _set_outputs(request, option_values(outputs or {}))
    request.beams, request.truth, request.calibration = os.fspath(beams), os.fspath(truth), os.fspath(calibration)
    if max_scans < 0 or threads < 0:
        raise Error(f"max_scans, threads: are {max_scans}, {threads}, expected 0 or more")
    request.max_scans, request.threads = max_scans, threads
    with progress_of(progress) as bar:
        return _perform(request, bar)


def _request(source: Recording | str | os.PathLike[str], options: Mapping[str, OptionValue]) -> _tilth.RunRequest:
    request = _tilth.RunRequest()
    request.values = option_values(options)
    if isinstance(source, Recording):
        request.source = source.uri
        request.read(*source.arguments)
    else:
        request.source = os.fspath(source)
        request.read("", "", 0.0, {})
    return request


def _set_outputs(request: _tilth.RunRequest, values: dict[str, str]) -> None:
    request.map = {key: values.pop(key) for key in MAP_OPTIONS if key in values}
    request.report = {key: values.pop(key) for key in REPORT_OPTIONS if key in values}
    request.output = values


def _perform(request: _tilth.RunRequest, bar: Progress | None) -> Run:
    outcome = _tilth.run(request, bar)
    if outcome.failures:
        raise Error("; ".join(outcome.failures))
    made = Run(outcome, request.out)
    if made.lost:
        warnings.warn(made.lost, TrackLostWarning, stacklevel=3)
    return made

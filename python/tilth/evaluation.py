"""The judge: an estimated trajectory against the true one (docs/evaluation.md has every formula)."""

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._tilth import Error
from tilth.trajectory import Trajectory


@dataclass(frozen=True)
class Metric:
    """The statistics of errors of one kind, as evo defines them, in their unit (sse: its square)."""

    rmse: float
    mean: float
    median: float
    std: float
    min: float
    max: float
    sse: float


@dataclass(frozen=True)
class Errors:
    """Errors of translation [m] and rotation [rad], their statistics, and those of E - I (Frobenius norm [-])."""

    translation: Metric
    rotation: Metric
    full: Metric
    translation_errors: NDArray[np.float64]
    rotation_errors: NDArray[np.float64]


class Evaluation:
    """What came of ``tilth.evaluate``; printed, it is the program's table."""

    def __init__(self, evaluation: _tilth.Evaluation) -> None:
        self._evaluation = evaluation
        self._json: dict[str, Any] = json.loads(evaluation.json())

    @property
    def ape(self) -> Errors:
        """Absolute pose errors: how far each pose of the estimate lies from its pose of the truth."""
        return _errors(self._json["ape"], *self._evaluation.ape_errors())

    @property
    def rpe(self) -> Errors:
        """Relative pose errors: of the motion between two poses."""
        return _errors(self._json["rpe"], *self._evaluation.rpe_errors())

    @property
    def truth(self) -> Trajectory:
        """The poses of the truth that were matched."""
        return Trajectory(*self._evaluation.truth())

    @property
    def estimate(self) -> Trajectory:
        """The poses of the estimate that were matched, aligned."""
        return Trajectory(*self._evaluation.estimate())

    @property
    def notices(self) -> list[str]:
        """What a reader of the figures must know; those that put them in doubt begin with "warning: "."""
        return list(self._json["notices"])

    def as_dict(self) -> dict[str, Any]:
        """Every figure, as ``tilth evaluate --json`` writes them."""
        return self._json

    def __str__(self) -> str:
        return self._evaluation.table()

    def __repr__(self) -> str:
        return f"Evaluation({self._json['matches']} matches, APE rmse {self.ape.translation.rmse:.4g} m)"


def evaluate(
    truth: Trajectory | str | os.PathLike[str],
    estimate: Trajectory | str | os.PathLike[str],
    *,
    calibration: str | os.PathLike[str] = "",
    **options: OptionValue,
) -> Evaluation:
    """Judges `estimate` by `truth`, each a Trajectory or a file of poses, as ``tilth evaluate`` does.

    calibration: KITTI's calib.txt, for a truth in the camera's frame; "none": not even one that lies beside the truth.
    options: the flags of ``tilth evaluate``: ``align="se3"`` (none, origin, se3, sim3), ``interpolate=True``,
        ``max_dt`` [s], ``rpe_delta``, ``kitti=True`` ...

    Raises tilth.Error where fewer than two poses match, and naming file and line, or the option and its bound.
    """
    if calibration and isinstance(truth, Trajectory):
        raise Error("calibration: is for a truth on file")
    judged = _judged(truth, "truth", os.fspath(calibration)), _judged(estimate, "estimate", "none")
    return Evaluation(_tilth.evaluate(*judged, option_values(options)))


def _judged(poses: Trajectory | str | os.PathLike[str], name: str, calibration: str) -> _tilth.JudgedPoses:
    if isinstance(poses, Trajectory):
        return _tilth.JudgedPoses.of(poses.stamps, poses.poses, name)
    return _tilth.JudgedPoses.read(os.fspath(poses), calibration)


def _errors(figures: Mapping[str, Any], translation: NDArray[np.float64], rotation: NDArray[np.float64]) -> Errors:
    def metric(kind: str) -> Metric:
        return Metric(**{name: value for name, value in figures[kind].items() if name != "unit"})

    return Errors(metric("translation"), metric("rotation_rad"), metric("full"), translation, rotation)

"""Drawings on matplotlib (``pip install tilth[plot]``)."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from tilth._tilth import Error
from tilth.evaluation import Evaluation
from tilth.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes

VIEWS = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


def trajectory(*trajectories: Trajectory, labels: list[str] | None = None, view: str = "xy", ax: Any = None) -> "Axes":
    """The ways of trajectories seen along an axis: "xy" from above, "xz" or "yz". Returns the axes."""
    axes = _axes(ax)
    across, up = _columns(view)
    for i, way in enumerate(trajectories):
        label = labels[i] if labels else None
        axes.plot(way.positions[:, across], way.positions[:, up], label=label)
    _finish(axes, view, legend=labels is not None)
    return axes


def cloud(points: ArrayLike, *, view: str = "xy", most: int = 200_000, ax: Any = None) -> "Axes":
    """A map or a scan, (n, 3) or (n, 4) [m], coloured along the line of sight; at most `most` points, evenly chosen."""
    axes = _axes(ax)
    across, up = _columns(view)
    shown = np.asarray(points)
    if shown.ndim != 2 or shown.shape[1] < 3:
        raise Error(f"points: has shape {shown.shape}, expected (n, 3) or (n, 4)")
    shown = shown[:: max(1, -(-len(shown) // most))]
    axes.scatter(shown[:, across], shown[:, up], c=shown[:, 3 - across - up], s=0.5, linewidths=0)
    _finish(axes, view, legend=False)
    return axes


def errors(evaluation: Evaluation, *, ax: Any = None) -> "Axes":
    """The absolute error of each position [m] over time [s]."""
    axes = _axes(ax)
    axes.plot(evaluation.estimate.stamps - evaluation.estimate.stamps[0], evaluation.ape.translation_errors)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("APE [m]")
    return axes


def _columns(view: str) -> tuple[int, int]:
    if view not in VIEWS:
        raise Error(f"view: is {view!r}, expected one of {', '.join(VIEWS)}")
    return VIEWS[view]


def _axes(ax: Any) -> "Axes":
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots()[1]
    made: "Axes" = ax
    return made


def _finish(axes: "Axes", view: str, legend: bool) -> None:
    axes.set_aspect("equal")
    axes.set_xlabel(f"{view[0]} [m]")
    axes.set_ylabel(f"{view[1]} [m]")
    if legend:
        axes.legend()

"""Tilth: trajectory and map from the scans of one spinning LiDAR, and nothing else.

Units are metres, seconds and radians; angles come first in 6-vectors and 6 x 6 matrices. ``T_a_b`` is a 4 x 4 array
that maps points of frame b into frame a. What is wrong with an input is raised as ``tilth.Error``, a ``ValueError``
that names the argument, file or option and its bound.
"""

from tilth._tilth import Error, Located, Registration, Result, Scan
from tilth._tilth import version as __version__
from tilth.evaluation import Errors, Evaluation, Metric, evaluate
from tilth.files import read_bin, read_pcd, read_ply, write_bin, write_las, write_pcd, write_ply
from tilth.localizer import Localizer
from tilth.made_run import Run, TrackLostWarning
from tilth.odometry import Odometry, Option, Slam, options, pipelines
from tilth.recording import Recording, Skipped, open
from tilth.running import run
from tilth.simulation import Simulation, simulate
from tilth.stages import Patches, deskew, neighbors, patches, register, remove_outliers
from tilth.studies import compare, sweep
from tilth.trajectory import Trajectory, read_trajectory

__all__ = [
    "Error",
    "Errors",
    "Evaluation",
    "Localizer",
    "Located",
    "Metric",
    "Odometry",
    "Option",
    "Patches",
    "Recording",
    "Registration",
    "Result",
    "Run",
    "Scan",
    "Simulation",
    "Skipped",
    "Slam",
    "TrackLostWarning",
    "Trajectory",
    "__version__",
    "compare",
    "deskew",
    "evaluate",
    "neighbors",
    "open",
    "options",
    "patches",
    "pipelines",
    "read_bin",
    "read_pcd",
    "read_ply",
    "read_trajectory",
    "register",
    "remove_outliers",
    "run",
    "simulate",
    "sweep",
    "write_bin",
    "write_las",
    "write_pcd",
    "write_ply",
]

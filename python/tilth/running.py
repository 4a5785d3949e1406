"""A whole recording at once, as ``tilth run`` does it."""

import os
import sys
import warnings
from collections.abc import Callable, Mapping

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._progress import Progress, progress_of
from tilth._tilth import Error
from tilth.made_run import Run, TrackLostWarning
from tilth.recording import Recording

VIEW_PORT = 8765


def run(
    source: Recording | str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    *,
    pipeline: str = "",
    config: str | os.PathLike[str] = "",
    loop_closure: bool = False,
    loop: Mapping[str, OptionValue] | None = None,
    save_map: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    localize: Mapping[str, OptionValue] | None = None,
    outputs: Mapping[str, OptionValue] | None = None,
    beams: str | os.PathLike[str] = "",
    learn_beams: bool = False,
    keep_beams: bool = False,
    base_from_lidar: str = "",
    level: bool = False,
    prior: str | os.PathLike[str] = "",
    truth: str | os.PathLike[str] = "",
    calibration: str | os.PathLike[str] = "",
    max_scans: int = 0,
    threads: int = 0,
    strict: bool = False,
    view: bool | int = False,
    view_host: str = "127.0.0.1",
    progress: bool | Callable[[int, int | None], object] = False,
    **options: OptionValue,
) -> Run:
    """Turns a recording into a trajectory and a map: the bits of ``tilth run``, and with `out` its files.

    source: a Recording, or what ``tilth.open`` takes.
    out: folder of trajectory.tum, map.pcd, report.html ... (docs/outputs.md); None: no files.
    pipeline, options: as those of tilth.Odometry; '': what `config` names, else "tilth".
    config: YAML file of options, which are weaker than those given here.
    loop_closure, loop: as tilth.Slam does.
    save_map: folder for the map, for tilth.Localizer; closes loops.
    map: folder of a map that the one to save goes on with, in its frame; `localize` as tilth.Localizer has it.
    outputs: of the map, the files and the report, as the flags of ``tilth run``: ``{"map_voxel": 0.05, "mcap": True}``.
    beams: file of the errors of the sensor's beams, which are taken out of every scan.
    learn_beams: errors of beams are taken out of the scans from where the drive has shown them.
    keep_beams: errors of beams that the drive shows are told only; else the run begins anew without them.
    base_from_lidar: how the LiDAR is mounted, "x,y,z,roll,pitch,yaw" [m, deg]: poses are then of the base_link.
    level: turn the map so that the floor below the first seconds is level.
    prior: file of the LiDAR's trajectory by another source (wheels, an IMU), by the clock of the scans.
    truth, calibration: file of true poses to judge the run by, and KITTI's calibration.
    max_scans: stop after so many; 0: all. threads: 0: as many as there are processors.
    strict: a record that cannot be used ends the run.
    view: True, or a port (0: any that is free): browsers and Foxglove may watch, at `view_host`; where, and what
        happens on the way, is said on standard error.
    progress: True: a bar where tqdm is installed; or a function of the scans so far and of all (None where not known).

    A run that lost its way warns with TrackLostWarning; see ``Run.lost``. Raises tilth.Error on what is wrong before
    the first scan, where no scan can be used, and where a file cannot be written. Ctrl-C, and what `progress` raises,
    end the run; they are raised once the files of what was registered so far are written.
    """
    if max_scans < 0 or threads < 0:
        raise Error(f"max_scans, threads: are {max_scans}, {threads}, expected 0 or more")
    if learn_beams and keep_beams:
        raise Error("keep_beams: excludes learn_beams")
    if map and (not save_map or level):
        raise Error("map: is what the map of save_map goes on with, in its frame: needs save_map, excludes level")
    arguments = _tilth.RecordingArguments()
    wanted = arguments.run
    _set_source(arguments, source)
    wanted.out = "" if out is None else os.fspath(out)
    wanted.options.pipeline, wanted.options.config = pipeline, os.fspath(config)
    given = option_values({**options, "loop": loop or {}, "localize": localize or {}})
    wanted.options.settings = [f"{key}={value}" for key, value in given.items()]
    wanted.loop_closure, wanted.save_map, wanted.map_to_continue = loop_closure, os.fspath(save_map), os.fspath(map)
    wanted.set_outputs(option_values(outputs or {}))
    wanted.beams, wanted.learn_beams, wanted.keep_beams = os.fspath(beams), learn_beams, keep_beams
    wanted.prior = os.fspath(prior)
    wanted.base_from_lidar, wanted.level, wanted.threads = base_from_lidar, level, threads
    arguments.truth, arguments.calibration = os.fspath(truth), os.fspath(calibration)
    wanted.set_session(max_scans, strict)
    if view is not False:
        wanted.set_view(view_host, VIEW_PORT if view is True else _port(view))
    with progress_of(progress) as bar:
        return _perform(arguments, bar, None if view is False else _say)


def _set_source(arguments: _tilth.RecordingArguments, source: Recording | str | os.PathLike[str]) -> None:
    if isinstance(source, Recording):
        arguments.run.source = source.uri
        arguments.set_input(*source.arguments)
    else:
        arguments.run.source = os.fspath(source)


def _port(number: int) -> int:
    if not 0 <= number <= 65535:
        raise Error(f"view: is {number}, expected a port from 0 (any that is free) to 65535")
    return number


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _perform(
    arguments: _tilth.RecordingArguments, bar: Progress | None, told: Callable[[str], None] | None
) -> Run:
    outcome = _tilth.run(arguments, bar, told)
    if outcome.failures:
        raise Error("; ".join(outcome.failures))
    made = Run(outcome, arguments.run.out)
    if made.lost:
        warnings.warn(made.lost, TrackLostWarning, stacklevel=3)
    return made

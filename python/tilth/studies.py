"""Many runs held against each other: the program's ``compare`` and ``sweep`` (docs/comparison.md).

Each run is a process of its own, so that its time and memory mean something; the same call again goes on where it was
stopped.
"""

import json
import os
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from tilth._options import OptionValue, option_values
from tilth.program import call

PathText = str | os.PathLike[str]


def compare(
    sources: Iterable[PathText],
    out: PathText,
    *,
    pipelines: Iterable[str] = (),
    peers: Iterable[str] = (),
    seeds: str = "",
    settings: Mapping[str, OptionValue] | None = None,
    **flags: OptionValue,
) -> dict[str, Any]:
    """Every pipeline, and odometries of others, on every source with every seed: the figures of comparison.json.

    sources: recordings with their truth beside them, sim://SCENE. out: folder of the runs and tables.
    pipelines: names, or NAME:key=value; none: all. peers: kiss_icp, genz_icp, mad_icp, small_gicp, where installed.
    seeds: of simulated sources, "1-5,8". settings: options of every pipeline.
    flags: the others of ``tilth compare``: ``jobs=2, max_scans=100, align="origin"``.

    "summary" has a row a source and method, "runs" one a run. Raises tilth.Error with the program's message.
    """
    arguments = _list("--pipelines", pipelines) + _list("--peers", peers) + ["--python", sys.executable]
    return _study("compare", arguments + _shared(sources, seeds, settings, flags), out, "comparison.json")


def sweep(
    parameters: Mapping[str, Iterable[OptionValue]],
    sources: Iterable[PathText],
    out: PathText,
    *,
    pipeline: str = "tilth",
    grid: bool = False,
    seeds: str = "",
    settings: Mapping[str, OptionValue] | None = None,
    **flags: OptionValue,
) -> dict[str, Any]:
    """What the parameters of a pipeline do, each alone or (`grid`) in every combination: the figures of sweep.json.

    parameters: values by dotted key: ``{"patches.max_misfit": [2, 3, 4]}``. The others are as those of compare.
    """
    arguments = ["--pipeline", pipeline] + (["--grid"] if grid else [])
    for key, values in parameters.items():
        texts = (option_values({key: value})[key] for value in values)
        arguments += ["--param", f"{key}={','.join(texts)}"]
    return _study("sweep", arguments + _shared(sources, seeds, settings, flags), out, "sweep.json")


def _shared(
    sources: Iterable[PathText],
    seeds: str,
    settings: Mapping[str, OptionValue] | None,
    flags: Mapping[str, OptionValue],
) -> list[str]:
    """The arguments that both commands have."""
    arguments = ["--seeds", seeds] if seeds else []
    for source in sources:
        arguments += ["--source", os.fspath(source)]
    for key, value in option_values(settings or {}).items():
        arguments += ["--set", f"{key}={value}"]
    for key, value in option_values(flags).items():
        flag = "--" + key.replace("_", "-")
        arguments += [flag] if value == "true" else [] if value == "false" else [flag, value]
    return arguments


def _study(command: str, arguments: list[str], out: PathText, file: str) -> dict[str, Any]:
    call([command, *arguments, "--out", os.fspath(out), "--quiet"])
    figures: dict[str, Any] = json.loads((Path(out) / file).read_text(encoding="utf-8"))
    return figures


def _list(flag: str, names: Iterable[str]) -> list[str]:
    text = ",".join(names)
    return [flag, text] if text else []

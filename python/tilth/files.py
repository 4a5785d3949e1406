"""Point clouds on file, as structured arrays of numpy: a field an attribute, of the type that it has in the file."""

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tilth import _tilth
from tilth._tilth import Error

PathText = str | os.PathLike[str]
Records = NDArray[np.void]


def read_pcd(path: PathText) -> Records:
    """PCD, versions 0.5 to 0.7: ascii, binary or binary_compressed; (n,) with the file's fields.

    Raises tilth.Error naming file, field and bound, as all of these functions do.
    """
    return _tilth.read_pcd(os.fspath(path))


def read_ply(path: PathText) -> Records:
    """PLY, ascii or binary: (n,) with the properties of its vertices."""
    return _tilth.read_ply(os.fspath(path))


def read_bin(path: PathText) -> Records:
    """KITTI's .bin: (n,) with x y z [m] intensity, and the columns that others add (nuScenes: ring)."""
    return _tilth.read_bin(os.fspath(path))


def write_pcd(path: PathText, records: Any) -> None:
    """PCD 0.7, binary, with all fields. `records` is a structured array, or (n, 3) or (n, 4): x y z [m] (intensity)."""
    _tilth.write_pcd(os.fspath(path), as_records(records))


def write_ply(path: PathText, records: Any) -> None:
    """PLY, binary_little_endian, with all fields; `records` as those of write_pcd."""
    _tilth.write_ply(os.fspath(path), as_records(records))


def write_bin(path: PathText, records: Any) -> None:
    """KITTI's .bin: x y z [m] intensity as float32, 0 where there is none; `records` as those of write_pcd."""
    _tilth.write_bin(os.fspath(path), as_records(records))


def write_las(path: PathText, records: Any) -> None:
    """LAS 1.4, uncompressed, coordinates rounded to 0.1 mm; `records` as those of write_pcd."""
    _tilth.write_las(os.fspath(path), as_records(records))


def write_cloud(path: PathText, records: Any) -> None:
    """Writes the format that the name ends in: .pcd, .ply, .las or .bin."""
    writers = {".pcd": write_pcd, ".ply": write_ply, ".las": write_las, ".bin": write_bin}
    write = writers.get(Path(path).suffix.lower())
    if write is None:
        raise Error(f"{os.fspath(path)}: ends in none of {', '.join(writers)}")
    write(path, records)


def as_records(records: Any) -> Records:
    """A structured array as it is; columns x y z (intensity) as one, of their own type."""
    array = np.asarray(records)
    if array.dtype.names is not None:
        return array
    if array.ndim != 2 or array.shape[1] not in (3, 4) or array.dtype.kind != "f":
        raise Error(
            f"records: has shape {array.shape} and type {array.dtype}, expected a structured array, or floats of shape "
            "(n, 3) or (n, 4)"
        )
    names = ("x", "y", "z", "intensity")[: array.shape[1]]
    made = np.empty(len(array), dtype=[(name, array.dtype) for name in names])
    for column, name in enumerate(names):
        made[name] = array[:, column]
    return made

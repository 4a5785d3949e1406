"""Options given to Python functions, as the library takes them: text by key."""

import os
from collections.abc import Iterator, Mapping
from typing import SupportsIndex, Union

from tilth._tilth import Error

Scalar = Union[bool, int, float, str, "os.PathLike[str]"]
OptionValue = Union[Scalar, "Mapping[str, OptionValue]"]


def option_values(options: Mapping[str, OptionValue]) -> dict[str, str]:
    """Nested mappings become dotted keys: ``{"align": {"max_iterations": 30}}`` is ``{"align.max_iterations": "30"}``.

    Raises tilth.Error where a value is no bool, number, text, path or mapping of these.
    """
    return dict(_spread("", options))


def _spread(prefix: str, options: Mapping[str, OptionValue]) -> Iterator[tuple[str, str]]:
    for key, value in options.items():
        if isinstance(value, Mapping):
            yield from _spread(f"{prefix}{key}.", value)
        else:
            yield prefix + key, _text(prefix + key, value)


def _text(key: str, value: object) -> str:
    if hasattr(value, "item") and getattr(value, "shape", None) == ():
        value = value.item()  # a number of numpy
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, SupportsIndex):
        return str(value.__index__())
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    raise Error(f"{key}: is a {type(value).__name__}, expected a bool, a number, text or a mapping of these")

"""Recordings, whatever their format, scan by scan."""

import os
from collections.abc import Iterator
from dataclasses import dataclass

from tilth import _tilth
from tilth._options import OptionValue, option_values
from tilth._tilth import Error, Scan


@dataclass(frozen=True)
class Skipped:
    """A record that could not be read and was passed over: its number, its file or message, what is wrong with it."""

    index: int
    where: str
    what: str


class Recording:
    """The scans of a recording in their order; ``tilth.open`` makes it.

    A loop over it begins anew each time, but for a sensor, which sends once. Reading the next scan lets other threads
    of Python run.
    """

    def __init__(self, uri: str, topic: str, frame: str, rate: float, values: dict[str, str]) -> None:
        self.uri = uri
        self.arguments = (topic, frame, rate, values)
        self._source = _tilth.open_source(uri, *self.arguments)
        self._used = False

    def __iter__(self) -> Iterator[Scan]:
        if self._used:
            self._source = _tilth.open_source(self.uri, *self.arguments)
        self._used = True
        source = self._source
        while (scan := source.next()) is not None:
            yield scan

    def __len__(self) -> int:
        """Scans in all. Raises TypeError where that is not known before the end is reached."""
        size = self._source.size()
        if size is None:
            raise TypeError(f"{self.uri}: how many scans it has is not known before its end")
        return size

    @property
    def contents(self) -> list[str]:
        """What it holds: topics with their types, fields with theirs."""
        return self._source.contents()

    @property
    def decisions(self) -> list[str]:
        """How it was understood: fields, rings, unit and reference of times; complete after the first scan."""
        return self._source.decisions()

    @property
    def notices(self) -> list[str]:
        """What was noticed beside scans: packets lost, other traffic; complete at the end of a loop over it."""
        return self._source.notices()

    @property
    def skipped(self) -> list[Skipped]:
        """Records passed over so far by the last loop over it."""
        return [Skipped(*row) for row in self._source.skipped()]

    def __repr__(self) -> str:
        return f"Recording({self.uri!r})"


def open(
    source: str | os.PathLike[str], *, topic: str = "", frame: str = "", rate: float = 0.0, **options: OptionValue
) -> Recording:
    """Opens a folder of scans, a KITTI sequence, a bag, a network capture, udp://:PORT or sim://SCENE, as the program.

    topic: of a bag with several point cloud topics.
    frame: frame_id of the sensor to read, where a topic has clouds of several.
    rate: [Hz] of scans whose times are not recorded; 0: 10 Hz, and said so.
    options: of packets and point clouds, as the flags of ``tilth run``: ``times="none"``, ``model="vlp16"``.

    Raises tilth.Error naming what is missing, not understood or means nothing for what is there.
    """
    if rate < 0:
        raise Error(f"rate: is {rate}, expected a positive number of scans a second, or 0")
    return Recording(os.fspath(source), topic, frame, float(rate), option_values(options))

"""How far a run is, for whoever looks on."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[int, int | None], object]


@contextmanager
def progress_of(wanted: bool | Progress) -> Iterator[Progress | None]:
    """The function to tell: none for False, that of a bar for True where tqdm is installed, else `wanted` itself."""
    if wanted is False:
        yield None
    elif wanted is not True:
        yield wanted
    else:
        try:
            from tqdm.auto import tqdm  # type: ignore[import-untyped]
        except ImportError:
            yield None
            return
        with tqdm(unit=" scans") as bar:

            def show(scans: int, total: int | None) -> None:
                bar.total = total
                bar.update(scans - bar.n)

            yield show

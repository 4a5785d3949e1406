"""The page of a run in a notebook: its 3D map, curves and tables (docs/report.md)."""

import html
import os
from pathlib import Path
from typing import Any

from tilth._tilth import Error
from tilth.made_run import Run


class ReportView:
    """A report that a notebook shows in a frame of its own; nothing is fetched from anywhere."""

    def __init__(self, report: Path, height: int) -> None:
        self.report, self.height = report, height

    def _repr_html_(self) -> str:
        page = html.escape(self.report.read_text(encoding="utf-8"), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: {self.height}px; border: 0"></iframe>'

    def __repr__(self) -> str:
        return f"ReportView({str(self.report)!r})"


def view(run: Run | str | os.PathLike[str], *, height: int = 800) -> Any:
    """The report of a run that has files, or of the folder of one, `height` pixels high: the last line of a cell.

    Raises tilth.Error where there is no report.html.
    """
    folder = run.out if isinstance(run, Run) else os.fspath(run)
    if not folder:
        raise Error("run: has no files; give tilth.run a folder as its second argument")
    report = Path(folder) / "report.html"
    if not report.is_file():
        raise Error(f"{report}: is missing")
    return ReportView(report, height)

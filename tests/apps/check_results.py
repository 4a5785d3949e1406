#!/usr/bin/env python3
"""scripts/results: its tables of the paper hold both ways to take scans, and its notes no folder of the machine.

check_results.py TILTH
"""

import importlib.machinery
import importlib.util
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "results"
ROWS = 1 + 4 * 3 + 2  # of each table: their robot; theirs and ours twice for each of theirs; tilth twice


def load(path):
    loader = importlib.machinery.SourceFileLoader("results", str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("results", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def check_notes(results, folder):
    told = f"Failed: office, seed 1, tilth: tilth run ended with 1: {folder}/runs/office-1/scans.pcd: has no scan."
    expected = "Failed: office, seed 1, tilth: tilth run ended with 1: runs/office-1/scans.pcd: has no scan."
    assert results.without_places(told, folder) == expected, results.without_places(told, folder)
    elsewhere = 'File "/usr/lib/python3/a.py", line 3: at 2 m/s, sim://office?k=1, 1/2: no /home/someone/x y'
    cut = 'File "a.py", line 3: at 2 m/s, sim://office?k=1, 1/2: no x y'
    assert results.without_places(elsewhere, folder) == cut, results.without_places(elsewhere, folder)


def check_paper(tilth, folder):
    document = folder / "results.md"
    document.write_text("before\n<!-- begin paper -->\nold\n<!-- end paper -->\nafter\n")
    subprocess.run([sys.executable, SCRIPT, "--tilth", tilth, "--out", folder / "out", "--parts", "paper", "--quick", "--seeds",
                    "301", "--jobs", "2", "--document", document], check=True)
    text = document.read_text()
    assert text.startswith("before\n") and text.endswith("after\n") and "old" not in text, text
    tables = text.split("### ")[1:]
    assert len(tables) == 2, text
    for table in tables:
        rows = [[cell.strip() for cell in line.strip("| \n").split("|")] for line in table.splitlines() if line.startswith("| ")]
        assert len(rows) == 2 + ROWS, table
        lego = [row[1] for row in rows if row[0].startswith("LeGO-LOAM")]
        assert lego == ["paper, simulation", "snapshot, `point_times=none`", "rolling"], lego
        ours = [row for row in rows[2:] if not row[1].startswith("paper")]
        assert len(ours) == 10, table
        for row in ours:
            assert all(re.fullmatch(r"\d+\.\d{4}", cell) for cell in row[2:8]) and row[8] == "0 of 1", row
        modes = {row[1].split(",")[0]: row[2:8] for row in ours if row[0] == "FLOAM"}
        assert modes["snapshot"] != modes["rolling"], "two ways to take scans"
    for mode in ("snapshot", "rolling"):
        assert (folder / "out" / f"paper_{mode}" / "comparison.json").is_file(), mode


with tempfile.TemporaryDirectory() as temporary:
    check_notes(load(SCRIPT), Path(temporary))
    check_paper(sys.argv[1], Path(temporary))
print("ok")

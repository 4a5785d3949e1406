"""The documents' site: it builds without a warning, fetches nothing, is searched, and a broken link or anchor is refused.

check_site.py
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))
from needs import needs  # noqa: E402

needs("material", "latex2mathml")

FETCHED = re.compile(r"<(?:script|link|img|iframe)\b[^>]*\b(?:src|href)=[\"']?https?:[^>]*>")


def build(root, out):
    return subprocess.run([root / "scripts/site", "--out", out], capture_output=True, text=True, timeout=300, check=False)


def check_pages(site):
    pages = list(site.rglob("*.html"))
    assert len(pages) > 40, len(pages)
    for page in pages:
        text = page.read_text()
        assert not FETCHED.search(text), (page, FETCHED.search(text)[0])
        assert 'class="arithmatex"' not in text, f"{page}: a formula that is no MathML"
    assert "<math" in (site / "method.html").read_text()
    assert "find_package" in (site / "library.html").read_text()
    assert "register_scan" in (site / "repository/examples/02_run_odometry.cpp.html").read_text()


def check_search(site):
    found = [entry["location"] for entry in json.loads((site / "search/search_index.json").read_text())["docs"]
             if "kidnap" in entry["text"] and "lost" in entry["text"]]
    assert any(location.startswith("tuning.html#") for location in found), found
    assert not any("02_run_odometry" in location for location in found), "sources are not searched"


def check_refusals(folder):
    """What is broken is named: a document, an anchor, a file of the repository, a page that no menu leads to."""
    root = folder / "root"
    for part in ("docs", "scripts", "examples", "cmake", "tilth"):
        shutil.copytree(ROOT / part, root / part, ignore=shutil.ignore_patterns("__pycache__"))
    (root / "web").mkdir()
    for part in ("mkdocs.yml", "README.md", "README.zh.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"):
        if (ROOT / part).exists():
            shutil.copy(ROOT / part, root)
    (root / ".venv/bin").mkdir(parents=True)
    (root / ".venv/bin/python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    (root / ".venv/bin/python").chmod(0o755)
    broken = ("gone.md", "tuning.md#gone", "../examples/gone.cpp", "../README.md#gone")
    page = root / "docs/first_map.md"
    whole = page.read_text()
    page.write_text(whole + "".join(f"\n[broken]({link})\n" for link in broken))
    (root / "docs/lonely.md").write_text("# Lonely\n")
    ended = build(root, folder / "refused")
    said = ended.stdout + ended.stderr
    assert ended.returncode != 0
    for name in ("'gone.md'", "'tuning.md#gone'", "'../examples/gone.cpp'", "README.md#gone'", "lonely.md"):
        assert name in said, (name, said)
    page.write_text(whole)
    (root / "docs/lonely.md").unlink()
    ended = build(root, folder / "refused")
    assert ended.returncode == 0, ended.stdout + ended.stderr


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ended = build(ROOT, folder / "site")
        assert ended.returncode == 0, ended.stdout + ended.stderr
        check_pages(folder / "site")
        check_search(folder / "site")
        check_refusals(folder)


if __name__ == "__main__":
    main()

"""`tilth completion` in the shells themselves, and `tilth manual` by mandoc.

check_completion.py TILTH

Shells and mandoc that are missing are named; bash is always there. What is offered is held against `tilth --help`.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/documents"))
from check_command_lines import Program  # noqa: E402

# The line so far, and what may come next: a part of it, then what must not be among it.
CASES = [
    ("tilth ", {"run", "map", "simulate", "completion"}, {"info2", "merge", "--out"}),
    ("tilth si", {"simulate"}, {"sensors"}),
    ("tilth run --l", {"--learn-beams", "--loop-closure", "--level"}, {"--out"}),
    ("tilth run --times ", {"auto", "none", "derived"}, {"--out", "run"}),
    ("tilth run drive --pipeline im", {"improved_floam"}, {"tilth"}),
    ("tilth map ", {"info", "merge", "import", "export"}, {"run"}),
    ("tilth map export --map-v", {"--map-voxel"}, {"--map-max-points"}),
    ("tilth simulate pla", {"plaza", "plaza_fast"}, {"office"}),
    ("tilth config flo", {"floam"}, {"tilth"}),
    ("tilth completion ", {"bash", "zsh", "fish"}, {"run"}),
    ("tilth run info --out lost --res", set(), {"--resume"}),
]


def said(*line, **more):
    return subprocess.run(line, capture_output=True, text=True, check=True, timeout=60, **more).stdout


def by_bash(script, line):
    words = line.split(" ")
    quoted = " ".join(f"'{word}'" for word in words)
    return said("bash", "-euc", f"source {script}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _tilth; "
                'printf "%s\\n" ${COMPREPLY[@]+"${COMPREPLY[@]}"}').split()


def by_fish(script, line):
    return [row.split("\t")[0] for row in said("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'").splitlines()]


def by_zsh(script, line):
    """Types the line and a tab into a zsh of its own, whose completion lists what it would offer one a line."""
    typed = (f"autoload -Uz compinit; compinit -D -u; source {script}; LISTMAX=0\n"
             "compadd() { local -a words; [[ ${@[1,(i)(-|--)]} == *-(O|A|D)* ]] && { builtin compadd \"$@\"; return }\n"
             "  builtin compadd -A words \"$@\"; print -rl -- $words >> offered; builtin compadd \"$@\" }\n"
             "complete_and_tell() { zle complete-word; : > told }; zle -N complete_and_tell; bindkey '^I' complete_and_tell\n"
             "precmd() { : > ready }\n")
    driver = ('zmodload zsh/zpty; zpty -b shell "ZDOTDIR=$1 zsh -i"\n'
              "wait_for() { until [[ -e $1 ]]; do zpty -r -t shell said; sleep 0.05; done }\n"
              "wait_for ready; zpty -w -n shell \"$2\"$'\\t'; wait_for told; zpty -d shell")
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / ".zshrc").write_text(typed)
        (Path(folder) / "offered").touch()
        said("zsh", "-fc", driver, "zsh", folder, line, cwd=folder)
        return (Path(folder) / "offered").read_text().split()


def check_shell(name, complete, program, folder):
    if shutil.which(name) is None:
        print(f"{name} is missing: its completion is not tried")
        return
    script = folder / f"tilth.{name}"
    script.write_text(said(program.path, "completion", name))
    for line, some, none in CASES:
        offered = set(complete(script, line))
        assert some <= offered, (name, line, some - offered, offered)
        assert not none & offered, (name, line, none & offered)
    for command in program.commands():
        offered = set(complete(script, f"tilth {command} -")) if name != "zsh" else program.options(command)
        missing = {option for option in program.options(command) if option.startswith("--")} - offered
        assert not missing, (name, command, missing)
    print(f"{name}: {len(CASES)} lines, options of {len(program.commands())} commands")


def check_manual(program, folder):
    said(program.path, "manual", folder / "manual")
    pages = {page.stem: page for page in (folder / "manual").iterdir()}
    assert set(pages) == {"tilth", *(f"tilth-{command}" for command in program.commands()),
                          *(f"tilth-map-{command}" for command in program.commands("map"))}, sorted(pages)
    if shutil.which("mandoc") is None:
        print("mandoc is missing: the pages are not tried")
        return
    for name, page in pages.items():
        lint = subprocess.run(["mandoc", "-Tlint", "-Wwarning", page], capture_output=True, text=True, check=False).stdout
        faults = [line for line in lint.splitlines() if "missing date" not in line]  # same source, same bytes: no date
        assert not faults, "\n".join(faults)
        text = re.sub(r".\x08", "", said("mandoc", "-Tutf8", "-Owidth=200", page))
        assert name in text, text
        for option in program.options(*name.split("-", 1)[1:]) if name in ("tilth-run", "tilth-live") else ():
            assert re.search(rf"{option}(?![-\w])", text), (name, option)
    print(f"{len(pages)} manual pages")


def main():
    program = Program(str(Path(sys.argv[1]).resolve()))
    os.environ["PATH"] = f"{Path(sys.argv[1]).resolve().parent}:{os.environ['PATH']}"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for shell, complete in (("bash", by_bash), ("fish", by_fish), ("zsh", by_zsh)):
            check_shell(shell, complete, program, folder)
        check_manual(program, folder)


if __name__ == "__main__":
    main()

"""Every command line of `tilth` that a document shows has a command and options that the program has.

check_command_lines.py TILTH

Looked at are blocks of sh and `tilth ...` within lines, of all documents. Options are what `tilth COMMAND --help` lists, keys of
--set what `tilth config` and `tilth simulate --help` do. Values are not looked at.
"""

import functools
import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^ *```sh\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`(tilth [^`]+)`")
STOP = {"&&", "||", "&", ";", "|", ">", "<", "2>&1"}
LEFT_OUT = ("CHANGELOG.md",)  # tells of what was


def output(*line):
    return subprocess.run(line, capture_output=True, text=True, check=True).stdout


class Program:
    def __init__(self, path):
        self.path = path

    @functools.cache
    def help(self, *command):
        return output(self.path, *command, "--help")

    @functools.cache
    def commands(self, *command):
        listed = self.help(*command).partition("\nSubcommands:\n")[2]
        return set(re.findall(r"^  ([a-z-]+)  ", listed, re.MULTILINE))

    @functools.cache
    def options(self, *command):
        """Of the lines that begin with names: `  -h,--help  ...`, `  --out TEXT REQUIRED  ...`."""
        names = re.findall(r"^  (-[-a-zA-Z0-9,]*)", self.help(*command), re.MULTILINE)
        return {name for line in names for name in line.split(",")}

    @functools.cache
    def keys(self):
        simulation = re.findall(r"^  (\w+) = ", self.help("simulate"), re.MULTILINE)
        return set(re.findall(r"^  ([a-z][\w.]*)  ", output(self.path, "config"), re.MULTILINE)) | set(simulation)


def joined(block):
    return re.sub(r"\\\n\s*", " ", block).splitlines()


def words_of(line):
    lexer = shlex.shlex(line, posix=True, punctuation_chars=";&|<>")
    lexer.whitespace_split = True
    return list(lexer)


def command_lines(text):
    """The words of each call of tilth: after the program's name, up to the next command or redirection."""
    for line in [line for block in BLOCK.findall(text) for line in joined(block)] + SPAN.findall(BLOCK.sub("", text)):
        call = None
        for word in [*words_of(line), ";"]:
            if call is None and (word == "tilth" or word.endswith("/tilth")):
                call = []
            elif call is not None and word in STOP:
                yield line, call
                call = None
            elif call is not None:
                call.append(word)


def fault(program, words):
    """What is wrong with a call, None where nothing is."""
    command, rest = [], words
    while rest and rest[0] in program.commands(*command):
        command, rest = [*command, rest[0]], rest[1:]
    if not command and rest and re.fullmatch(r"[a-z]+(-[a-z]+)*", rest[0]):
        return f"there is no command {rest[0]}"
    for i, word in enumerate(rest):
        name = word.partition("=")[0]
        if re.fullmatch(r"--?[a-zA-Z][-a-z0-9]*", name) and name not in program.options(*command):
            return f"`{' '.join(['tilth', *command])}` has no option {name}"
        setting = re.fullmatch(r"([a-z][\w.]*)=.*", word)
        if setting and i > 0 and rest[i - 1] == "--set" and setting[1] not in program.keys() | {"key"}:
            return f"there is no option {setting[1]} to set"
    return None


def check_the_checker(program):
    good = ("tilth run A --out B", "tilth map info MAP", "tilth run A --set max_range=3 && tilth assess B", "tilth --version",
            "tilth ...", "tilth COMMAND --help", "tilth simulate plaza --set people=3 --out '...' # --no-option of a comment")
    bad = ("tilth runn A", "tilth run A --outt B", "tilth run A --set max_rang=3", "tilth map --out B", "tilth config tilth --out")
    for line in good:
        assert [fault(program, words) for _, words in command_lines(f"```sh\n{line}\n```\n")][0] is None, line
    for line in bad:
        calls = list(command_lines(f"see `{line}`"))
        assert calls and all(fault(program, words) for _, words in calls), line


def main():
    program = Program(sys.argv[1])
    check_the_checker(program)
    documents = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    lines, faults = 0, []
    for document in sorted(documents):
        if document.name in LEFT_OUT:
            continue
        for line, words in command_lines(document.read_text()):
            lines += 1
            wrong = fault(program, words)
            if wrong:
                faults.append(f"{document.relative_to(ROOT)}: {line}\n    {wrong}")
    print(f"{lines} command lines of {len(documents)} documents")
    assert lines > 200, lines
    assert not faults, "\n".join(faults)


if __name__ == "__main__":
    main()

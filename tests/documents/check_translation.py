"""README.zh.md says what README.md says: part by part the same commands, code, links and numbers, in the same order of parts.

check_translation.py

A part is what stands between two empty lines, or one fenced block. What is compared leaves out the words: commands without their
comments, spans of code, targets of links, numbers, rows of tables.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])\d[\d.,]*\d|(?<![\w.])\d")
SAID_IN_WORDS = {"1", "2", "3"}  # ROS 1, ROS 2: where the translation repeats them


def paragraphs(text):
    return [paragraph.strip("\n") for paragraph in re.split(r"\n\s*\n", text) if paragraph.strip()]


def parts_of(text):
    parts, end = [], 0
    for fence in FENCE.finditer(text):
        parts += [*paragraphs(text[end:fence.start()]), fence[0]]
        end = fence.end()
    return parts + paragraphs(text[end:])


def commands(block):
    """A block of code without its comments; of a tree only the names."""
    return [re.split(r"\s+#|\s*//|(?<=\S)  +", line)[0].rstrip() for line in block.splitlines()]


def essence(part):
    fence = FENCE.fullmatch(part)
    if fence:
        return commands(fence[2])
    spans = sorted(span for span in re.findall(r"`([^`]+)`", part))
    links = sorted(re.findall(r"\]\(([^)]+)\)", part))
    words = re.sub(r"`[^`]+`|\]\([^)]+\)|\[docs/[^]]*\]", " ", part)
    numbers = sorted(set(NUMBER.findall(words)) - SAID_IN_WORDS)
    rows = len(re.findall(r"^\|", part, re.MULTILINE))
    head = re.match(r"#*", part)[0]
    return head, rows, spans, links, numbers


def faults(english, chinese):
    ours, theirs = parts_of(english), parts_of(chinese)
    if len(ours) != len(theirs):
        return [f"{len(ours)} parts in README.md, {len(theirs)} in README.zh.md"]
    pairs = [(a, b) for a, b in zip(ours, theirs, strict=True) if "README" not in a.splitlines()[0]]
    return [f"{a}\n  {essence(a)}\n{b}\n  {essence(b)}" for a, b in pairs if essence(a) != essence(b)]


def main():
    english, chinese = ((ROOT / name).read_text() for name in ("README.md", "README.zh.md"))
    assert len(parts_of(english)) > 25
    for changed in ((english.replace("--loop-closure", "--loops"), chinese), (english, chinese.replace("0.0258", "0.0285")),
                    (english, chinese.replace("docs/paper.md", "docs/papers.md")), (english + "\nMore.\n", chinese)):
        assert faults(*changed), "a difference is not noticed"
    wrong = faults(english, chinese)
    print("\n\n".join(wrong) or "README.zh.md says what README.md says")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()

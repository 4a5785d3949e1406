"""Counts test cases: count_tests.py RESULTS, a folder of ctest.xml and one <program>.xml a GoogleTest program.

Names what was skipped and why, and ends with "<n> passed, <n> failed, <n> skipped". A test of ctest that wrote no file of
its own (a script, a program that crashed) counts as one case. With CI=true what is skipped for want of a package from PyPI
counts as failed. Exit status 1 where a case failed or none ran.
"""

import os
import sys
import xml.etree.ElementTree as xml
from pathlib import Path


def outcome(case):
    """(passed | failed | skipped, reason) of one <testcase>, as GoogleTest, pytest and ctest write them."""
    for failure in ("failure", "error"):
        if case.find(failure) is not None:
            return "failed", ""
    skipped = case.find("skipped")
    if skipped is not None or case.get("status") in ("notrun", "disabled"):
        reason = "" if skipped is None else f"{skipped.get('message') or ''} {skipped.text or ''}"
        return "skipped", " ".join(reason.split())
    return "passed", ""


def cases_of(path):
    for case in xml.parse(path).iter("testcase"):
        name = f"{case.get('classname')}.{case.get('name')}"
        yield name, *outcome(case)


def all_cases(results):
    """Every case of every program; the tests of ctest itself where they have no file, or failed without a failed case."""
    programs = {p.stem: list(cases_of(p)) for p in sorted(results.glob("*.xml")) if p.stem != "ctest"}
    for cases in programs.values():
        yield from cases
    for case in xml.parse(results / "ctest.xml").iter("testcase"):
        name = case.get("name")
        result, reason = outcome(case)
        cases = programs.get(f"tilth_{name}_test", programs.get(name))
        explained = cases is not None and (result != "failed" or any(c[1] == "failed" for c in cases))
        if not explained:
            yield name, result, reason


def main():
    in_ci = os.environ.get("CI") == "true"
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for name, result, reason in all_cases(Path(sys.argv[1])):
        if result == "skipped" and in_ci and "PyPI" in reason:
            result, reason = "failed", f"skipped in CI: {reason}"
        if result != "passed":
            print(f"{result}: {name}" + (f" ({reason})" if reason else ""))
        count[result] += 1
    print(f"{count['passed']} passed, {count['failed']} failed, {count['skipped']} skipped")
    return 1 if count["failed"] or not count["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())

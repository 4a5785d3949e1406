"""Packages and programs that a test needs: where one is missing the test is skipped by name, or fails where CI=true."""

import importlib
import os
import shutil
import sys

SKIPPED = 77


def skip(what):
    print(f"SKIPPED: needs {what}")
    sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)


def needs(*packages):
    """The modules named `packages`; ends the test where one cannot be imported."""
    modules = []
    for package in packages:
        try:
            modules.append(importlib.import_module(package))
        except ImportError:
            skip(f"the Python package {package}")
    return modules


def needs_program(name, package):
    """The path of the program `name` of the Debian package `package`; ends the test where it is missing."""
    path = shutil.which(name)
    if path is None:
        skip(f"the program {name} of the Debian package {package}")
    return path

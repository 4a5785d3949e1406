"""Packages that a test needs: where one is missing the test is skipped by name, or fails where CI=true."""

import importlib
import os
import sys

SKIPPED = 77


def needs(*packages):
    """The modules named `packages`; ends the test where one cannot be imported."""
    modules = []
    for package in packages:
        try:
            modules.append(importlib.import_module(package))
        except ImportError:
            print(f"SKIPPED: needs the Python package {package}")
            sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    return modules

#!/usr/bin/env python3
"""Has the workers of a Dask scheduler run commands, each at most three times where a worker dies under it.

run_jobs_dask.py --scheduler ADDRESS COMMANDS       COMMANDS: JSON, a list of argument lists

`tilth sweep --engine dask` and `tilth compare --engine dask` call it. The workers must see the same folders and the same
program. Progress goes to standard error. Ends with 1 where a command was given up or failed.
"""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path


def run_command(command):
    """On a worker: the exit code, and the last of what was said."""
    ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return ended.returncode, ended.stdout[-500:]


def say(done, total, begin):
    if sys.stderr.isatty():
        left = (time.monotonic() - begin) / done * (total - done)
        print(f"\r\033[K{done} of {total} runs  {100 * done // total} %  {left:.0f} s left", end="", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scheduler", required=True)
    parser.add_argument("commands", type=Path)
    arguments = parser.parse_args()
    try:
        from dask.distributed import Client, as_completed
    except ImportError:
        sys.exit("the Python packages dask and distributed are missing")
    commands = json.loads(arguments.commands.read_text())
    failed, begin = 0, time.monotonic()
    with Client(arguments.scheduler) as client:
        futures = client.map(run_command, commands, pure=False)
        names = dict(zip((future.key for future in futures), commands))
        for done, future in enumerate(as_completed(futures), 1):
            say(done, len(commands), begin)
            if future.status == "finished" and future.result()[0] == 0:
                continue
            failed += 1
            why = future.result()[1] if future.status == "finished" else future.exception()
            print(f"{' '.join(names[future.key])}: {why}", file=sys.stderr)
    if sys.stderr.isatty():
        print(file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

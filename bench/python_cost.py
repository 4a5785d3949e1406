#!/usr/bin/env python3
"""What Python adds to registering a scan: taskset -c 0 python bench/python_cost.py [ROUNDS]

CPU time [ms] of the registering thread over the scans of a simulated drive, on one core: in the loop of `tilth.run`,
which is C++ (less the time in which that watches the beams), and in a loop of Python that hands over arrays and takes
the pose. Of each scan the least of some rounds, which alternate, so that other work on the machine counts little; means
over the scans.
"""

import csv
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import tilth


def in_cpp(recording):
    with tempfile.TemporaryDirectory() as out:
        tilth.run(recording, out, threads=1)
        rows = list(csv.DictReader((Path(out) / "scans.csv").open()))
    return [float(row["cpu_ms_register"]) - float(row["ms_beams"]) for row in rows]


def in_python(scans):
    odometry, spent = tilth.Odometry(), []
    for points, times, rings, intensities, stamp in scans:
        begin = time.thread_time()
        result = odometry.register_scan(points, times, rings, intensities, stamp=stamp)
        result.T_world_lidar
        spent.append(1e3 * (time.thread_time() - begin))
        del result  # as the loop in C++, outside of the time
    return spent


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    with tempfile.TemporaryDirectory() as recording:
        tilth.simulate("corridor_fast", recording, seed=5, duration=8)
        scans = [(s.points, s.times, s.rings, s.intensities, s.stamp) for s in tilth.open(recording)]
        pairs = [(in_cpp(recording), in_python(scans)) for _ in range(rounds)]
    cpp, python = (np.mean(np.min(times, axis=0)) for times in zip(*pairs, strict=True))
    print(f"{len(scans)} scans of {len(scans[0][0])} points: C++ {cpp:.3f} ms, Python {python:.3f} ms "
          f"({100 * (python / cpp - 1):+.1f} %)")


if __name__ == "__main__":
    main()

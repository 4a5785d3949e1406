#!/usr/bin/env python3
"""How often one scan is found in another without a guess: python bench/register_without_guess.py [SEED] [PAIRS]

Pairs of scans of simulated drives, each taken at once, the first of them turned about z at random and tilted by up to
15 degrees. By scene and distance: how many were found within 0.2 m, were ambiguous, were not found, or were WRONG; then
pairs of different scenes, of which every "found" is WRONG.
"""

import itertools
import sys
import time
from collections import Counter

import numpy as np

import tilth

SCENES = ("plaza", "office", "hospital", "corridor")


def rotation(axis, angle):
    """(4, 4) about a unit vector, by Rodrigues' formula."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    T = np.eye(4)
    T[:3, :3] += np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    return T


def turned(scan, rng):
    towards = rng.uniform(-np.pi, np.pi)
    tilt = rotation((np.cos(towards), np.sin(towards), 0), np.radians(rng.uniform(0, 15)))
    T_turned_scan = tilt @ rotation((0, 0, 1), rng.uniform(-np.pi, np.pi))
    return tilth.Scan(scan.points @ T_turned_scan[:3, :3].T, rings=scan.rings, stamp=0.0), T_turned_scan


def standing(scene, seed):
    """15 scans of a drive and where they were taken."""
    drive = tilth.simulate(scene, seed=seed, duration=30, snapshot=True, people=2)
    scans = [drive[i] for i in range(0, len(drive), len(drive) // 15)]
    return [(s, drive.truth.poses[np.abs(drive.truth.stamps - s.stamp).argmin()]) for s in scans]


def judged(found, T_target_source):
    if found.answer != "found":
        return found.answer
    error = np.linalg.inv(found.T_target_source) @ T_target_source
    return "found" if np.linalg.norm(error[:3, 3]) < 0.2 else "WRONG"


def main():
    seed = int(sys.argv[1]) if len(sys.argv) > 1 else 821
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    rng, spent = np.random.default_rng(seed), []
    scans = {scene: standing(scene, seed) for scene in SCENES}
    for scene in SCENES:
        pairs, told = list(itertools.permutations(scans[scene], 2)), {}
        for k in rng.permutation(len(pairs))[:count]:
            (source, T_world_source), (target, T_world_target) = pairs[k]
            T_target_source = np.linalg.inv(T_world_target) @ T_world_source
            source, T_turned_source = turned(source, rng)
            begin = time.process_time()
            found = tilth.register(source, target)
            spent.append(time.process_time() - begin)
            told.setdefault(int(np.linalg.norm(T_target_source[:3, 3]) // 2) * 2, Counter())[
                judged(found, T_target_source @ np.linalg.inv(T_turned_source))
            ] += 1
        for distance in sorted(told):
            print(f"{scene}, {distance} to {distance + 2} m: {dict(told[distance])}", flush=True)
    answers = Counter()
    for _ in range(count):
        one, other = rng.choice(SCENES, 2, replace=False)
        source, target = (scans[scene][rng.integers(len(scans[scene]))][0] for scene in (one, other))
        answers[tilth.register(turned(source, rng)[0], target).answer] += 1
    print(f"different scenes: {dict(answers)}; {np.median(spent):.2f} s CPU time a pair (median)")


if __name__ == "__main__":
    main()

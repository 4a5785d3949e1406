"""Pairs of a true and an estimated trajectory on which two judges must agree: made up with fixed seeds, and real ones.

A trajectory is an array of rows (stamp [s], x, y, z [m], qx, qy, qz, qw). Every pair is written as two files.
"""

import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation


EUROC_HEADER = ",".join(
    ["#timestamp"]
    + [f"p_RS_R_{axis} [m]" for axis in "xyz"]
    + [f"q_RS_{axis} []" for axis in "wxyz"]
    + [f"v_RS_R_{axis} [m s^-1]" for axis in "xyz"]
    + [f"b_w_RS_S_{axis} [rad s^-1]" for axis in "xyz"]
    + [f"b_a_RS_S_{axis} [m s^-2]" for axis in "xyz"]
)


@dataclass
class Pair:
    name: str
    truth: np.ndarray
    estimate: np.ndarray
    kitti: bool = False  # written as 3x4 matrices
    euroc: bool = False  # written as EuRoC's tables: nanoseconds, commas, a header that puts w first
    digits: int = 17  # written
    max_dt: float = 0.01
    time_offset: float = 0.0
    interpolate: bool = False
    metres: float = 1.0  # of RPE
    own_refusals: tuple = field(default_factory=tuple)  # alignments that evo takes from rounding errors


def _trajectory(stamps, positions, rotations):
    return np.column_stack([stamps, positions, rotations.as_quat()])


def walk(rng, n, step=0.1, dt=0.1, turn=0.05, start=0.0):
    """A random walk in space, with smooth-ish turns."""
    rotation = Rotation.identity()
    rotations, positions = [], [np.zeros(3)]
    for _ in range(n):
        rotation = rotation * Rotation.from_rotvec(rng.normal(0, turn, 3))
        rotations.append(rotation)
        positions.append(positions[-1] + rotation.apply([step * rng.uniform(0.2, 1.8), 0, 0]))
    return _trajectory(start + dt * np.arange(n), np.array(positions[:n]), Rotation.concatenate(rotations))


def circle(n, radius=5.0, turns=2.0, dt=0.1, rise=0.0):
    angle = np.linspace(0, 2 * np.pi * turns, n)
    positions = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), rise * angle])
    return _trajectory(dt * np.arange(n), positions, Rotation.from_rotvec(np.outer(angle, [0, 0, 1])))


def line(n, direction, dt=0.1):
    positions = np.outer(np.arange(n) * 0.23, direction)  # no whole number of steps is a whole metre
    return _trajectory(dt * np.arange(n), positions, Rotation.identity(n))


def bends(rng, n, metres):
    """To be added to a trajectory: positions off by so much, stamps and rotations as they are."""
    return np.column_stack([np.zeros(n), rng.normal(0, metres, (n, 3)), np.zeros((n, 4))])


def noisy(rng, trajectory, metres=0.02, radians=0.01):
    rotations = Rotation.from_quat(trajectory[:, 4:]) * Rotation.from_rotvec(rng.normal(0, radians, (len(trajectory), 3)))
    positions = trajectory[:, 1:4] + rng.normal(0, metres, (len(trajectory), 3))
    return _trajectory(trajectory[:, 0], positions, rotations)


def drifting(rng, trajectory, metres=0.01, radians=0.002):
    """The truth's motions, each with an error, put together again."""
    rotations, positions = Rotation.from_quat(trajectory[:, 4:]), trajectory[:, 1:4]
    rotation, position = rotations[0], positions[0]
    out_rotations, out_positions = [rotation], [position]
    for i in range(1, len(trajectory)):
        motion = rotations[i - 1].inv().apply(positions[i] - positions[i - 1]) + rng.normal(0, metres, 3)
        position = position + rotation.apply(motion)
        rotation = rotation * rotations[i - 1].inv() * rotations[i] * Rotation.from_rotvec(rng.normal(0, radians, 3))
        out_rotations.append(rotation)
        out_positions.append(position)
    return _trajectory(trajectory[:, 0], np.array(out_positions), Rotation.concatenate(out_rotations))


def moved(trajectory, rotvec, translation, scale=1.0):
    """Given in another world frame."""
    R = Rotation.from_rotvec(rotvec)
    positions = scale * R.apply(trajectory[:, 1:4]) + translation
    return _trajectory(trajectory[:, 0], positions, R * Rotation.from_quat(trajectory[:, 4:]))


def shifted(trajectory, seconds):
    return np.column_stack([trajectory[:, 0] + seconds, trajectory[:, 1:]])


def jittered(rng, trajectory, seconds):
    rows = shifted(trajectory, rng.uniform(-seconds, seconds, len(trajectory)))
    return rows[np.argsort(rows[:, 0])]


def thinned(rng, trajectory, keep):
    return trajectory[rng.random(len(trajectory)) < keep]


def _shapes(rng):
    long_walk = walk(rng, 1500, step=0.8, turn=0.02)
    diagonal = line(200, [0.6, 0.0, 0.8])
    return [
        Pair("walk with noise", w := walk(rng, 400), noisy(rng, w)),
        Pair("walk with drift", w := walk(rng, 500), drifting(rng, w)),
        Pair("errors of a micrometre", w := walk(rng, 200), noisy(rng, w, 1e-6, 1e-6)),
        Pair("no errors", w := walk(rng, 200), w),
        Pair("circle in a plane", c := circle(300), drifting(rng, c), metres=2.0),
        Pair("helix", c := circle(300, rise=0.3), noisy(rng, c), metres=2.0),
        Pair("line along x", x := line(200, [1, 0, 0]), x * [1, 1.01, 1, 1, 1, 1, 1, 1]),
        Pair("line aslant", diagonal, diagonal * [1, 1.01, 1, 1.01, 1, 1, 1, 1], own_refusals=("se3", "sim3")),
        Pair("line with noise", diagonal, noisy(rng, diagonal), own_refusals=("se3", "sim3")),
        Pair("nearly a line", l := line(200, [1, 0, 0]) + bends(rng, 200, 0.05), noisy(rng, l, 0.01)),
        Pair("at rest", r := line(100, [0, 0, 0]), r),
        Pair("at rest with noise", r := line(100, [0, 0, 0]), noisy(rng, r, 0.005), metres=0.05),
        Pair("turned by nearly pi", w := walk(rng, 200), moved(noisy(rng, w), [3.1, 0.2, -0.1], [1, 2, 3])),
        Pair("another frame", w := walk(rng, 300), moved(drifting(rng, w), [0.4, -1.0, 2.0], [30, -20, 5])),
        Pair("another scale", w := walk(rng, 300), moved(noisy(rng, w), [0.1, 0.2, 1.3], [3, -2, 5], 0.37), metres=0.5),
        Pair("mirrored", w := walk(rng, 300), noisy(rng, w * [1, 1, 1, -1, 1, 1, 1, 1])),
        Pair("long", long_walk, drifting(rng, long_walk), metres=10.0),
        Pair("three poses", w := walk(rng, 3), noisy(rng, w), metres=0.1),
        Pair("two poses", w := walk(rng, 2), noisy(rng, w), metres=0.1),
    ]


def _times(rng):
    fine, coarse = walk(rng, 2000, step=0.02, turn=0.01, dt=0.005), slice(100, 1900, 10)
    epoch = walk(rng, 300, start=1.6e9)
    return [
        Pair("truth of a higher rate", fine, jittered(rng, noisy(rng, fine[coarse]), 0.004), metres=0.3),
        Pair("truth of a lower rate", fine[coarse], jittered(rng, noisy(rng, fine), 0.002), metres=0.3),
        Pair("matched twice", w := walk(rng, 300), jittered(rng, noisy(rng, w), 0.09)[:250], max_dt=0.06),
        Pair("missing poses", thinned(rng, w := walk(rng, 600), 0.8), thinned(rng, noisy(rng, w), 0.7)),
        Pair("time offset", w := walk(rng, 300), shifted(noisy(rng, w), -0.37)[20:], time_offset=0.37),
        Pair("time offset, longer estimate", (w := walk(rng, 300))[30:], shifted(noisy(rng, w), 5.0), time_offset=-5.0),
        Pair("stamps since 1970", epoch, jittered(rng, drifting(rng, epoch), 0.003)),
        Pair("partly overlapping", (w := walk(rng, 400))[:300], noisy(rng, w)[150:]),
        Pair("interpolated truth", fine, jittered(rng, noisy(rng, fine[coarse]), 0.004), metres=0.3, interpolate=True),
    ]


def _files(rng):
    street = walk(rng, 600, step=1.0, turn=0.01)
    return [
        Pair("KITTI files", street, drifting(rng, street), kitti=True, metres=20.0),
        Pair("KITTI files of 7 digits", street, drifting(rng, street), kitti=True, digits=7, metres=20.0),
        Pair("EuRoC files", w := walk(rng, 300, start=1.4e9), drifting(rng, w), euroc=True),
        Pair("TUM files of 6 digits", w := walk(rng, 300), drifting(rng, w), digits=6),
    ]


def _real(rng):
    root = Path(os.environ.get("TILTH_DATA", Path(__file__).resolve().parents[3] / "shared" / "data"))
    files = {
        "KITTI 00": (root / "kitti00-first16/poses_lidar_tum.txt", 2.0),
        "Hilti 14": (root / "xt32-hilti14/poses_tum.txt", 0.5),
        "outdoor loop": (root / "vlp16-outdoor-loop/icp_reference_tum.txt", 5.0),
    }
    pairs = []
    for name, (path, metres) in files.items():
        if not path.exists():
            print(f"left out: {path} is missing")
            continue
        truth = np.loadtxt(path)
        pairs.append(Pair(name + ", drift", truth, drifting(rng, truth), metres=metres))
        pairs.append(Pair(name + ", noise, moved", truth, moved(noisy(rng, truth), [0, 0, 0.7], [4, 5, 6]), metres=metres))
    return pairs


def all_pairs():
    rng = np.random.default_rng(20261122)
    return _shapes(rng) + _times(rng) + _files(rng) + _real(rng)


def write(path, trajectory, pair):
    rows = trajectory
    if pair.kitti:
        matrices = Rotation.from_quat(trajectory[:, 4:]).as_matrix()
        rows = np.concatenate([matrices, trajectory[:, 1:4, None]], axis=2).reshape(-1, 12)
        np.savetxt(path, rows, fmt=f"%.{pair.digits - 1}e")
    elif pair.euroc:
        lines = [EUROC_HEADER]
        for stamp, *position, x, y, z, w in rows.tolist():
            lines.append(",".join([str(round(stamp * 1e9))] + [repr(v) for v in (*position, w, x, y, z)] + ["0.5"] * 9))
        Path(path).write_text("\r\n".join(lines) + "\r\n")
    else:
        np.savetxt(path, rows, fmt=["%.9f"] + [f"%.{pair.digits}g"] * 7)

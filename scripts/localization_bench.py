"""What scripts/localization is made of: poses, truth, made drives, maps of them, and what is found in those."""

import csv
import math
import subprocess
import sys
from bisect import bisect_left
from pathlib import Path

ANOTHER = {"corridor": "hospital", "hospital": "office", "office": "corridor", "plaza": "street", "city": "plaza",
           "street": "plaza", "auditorium": "office", "doors": "hospital"}
RIGHT, RIGHT_ANGLE = 0.3, math.radians(3)  # [m] [rad] of a place
DOORS = "4,0;56,0"  # [m] way through the corridor of identical doors


def product(a, b):
    """Of two quaternions x y z w."""
    x, y, z, w = a
    i, j, k, r = b
    return (w * i + x * r + y * k - z * j, w * j - x * k + y * r + z * i, w * k + x * j - y * i + z * r,
            w * r - x * i - y * j - z * k)


class Pose:
    """x y z [m] and a unit quaternion x y z w."""

    def __init__(self, t, q):
        self.t, self.q = tuple(t), tuple(q)

    def turned(self, v):
        x, y, z, w = product(product(self.q, (*v, 0.0)), (-self.q[0], -self.q[1], -self.q[2], self.q[3]))
        return x, y, z

    def inverse(self):
        back = Pose((0, 0, 0), (-self.q[0], -self.q[1], -self.q[2], self.q[3]))
        return Pose([-v for v in back.turned(self.t)], back.q)

    def __mul__(self, other):
        return Pose([a + b for a, b in zip(self.t, self.turned(other.t))], product(self.q, other.q))

    def distance(self):
        return math.hypot(*self.t)

    def turn(self):
        """Rotation vector [rad]."""
        x, y, z, w = self.q if self.q[3] >= 0 else [-v for v in self.q]
        sine = math.hypot(x, y, z)
        scale = 2.0 if sine < 1e-9 else 2 * math.atan2(sine, w) / sine
        return scale * x, scale * y, scale * z

    def angle(self):
        return math.hypot(*self.turn())


class Track:
    """Poses of a TUM file; between two of them, which at the 200 Hz of truth are 5 ms apart, linear in both parts."""

    def __init__(self, path):
        rows = [[float(word) for word in line.split()] for line in open(path, encoding="utf-8") if line[0] != "#"]
        self.stamps = [row[0] for row in rows]
        self.poses = [Pose(row[1:4], row[4:8]) for row in rows]

    def at(self, stamp):
        i = min(max(bisect_left(self.stamps, stamp), 1), len(self.stamps) - 1)
        s = (stamp - self.stamps[i - 1]) / (self.stamps[i] - self.stamps[i - 1])
        a, b = self.poses[i - 1], self.poses[i]
        sign = 1 if sum(u * v for u, v in zip(a.q, b.q)) > 0 else -1
        q = [(1 - s) * u + sign * s * v for u, v in zip(a.q, b.q)]
        size = math.hypot(*q)
        return Pose([(1 - s) * u + s * v for u, v in zip(a.t, b.t)], [v / size for v in q])


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else float("nan")


def identical_doors(path):
    """60 m of corridor, open at both ends, whose doors are 3 m apart and alike."""
    box = ('<visual name="{}"><pose>{} {} {} 0 0 0</pose><geometry><box><size>{} {} {}</size></box></geometry>'
           '<material><diffuse>{c} {c} {c} 1</diffuse></material></visual>')
    parts = [box.format("floor", 30, 0, -0.1, 60, 2.8, 0.2, c=0.5),
             box.format("ceiling", 30, 0, 3.1, 60, 2.8, 0.2, c=0.8)]
    for side in (-1, 1):
        parts.append(box.format(f"wall{side}", 30, 1.4 * side, 1.5, 60, 0.2, 3, c=0.7))
        for i in range(20):  # the frame of each stands out by 0.1 m
            for j, x in enumerate((1 + 3 * i, 2 + 3 * i)):
                parts.append(box.format(f"jamb{side}_{i}_{j}", x, 1.25 * side, 1.05, 0.12, 0.1, 2.1, c=0.4))
    head = '<sdf version="1.9"><world name="doors"><model name="corridor"><static>true</static><link name="link">'
    path.write_text(head + "".join(parts) + "</link></model></world></sdf>\n", encoding="utf-8")


class Bench:
    """Runs the program `tilth`; what is done already in the folder `work` is not done again."""

    def __init__(self, tilth, work, extra):
        self.tilth, self.work, self.extra = tilth, Path(work), list(extra)
        self.work.mkdir(parents=True, exist_ok=True)

    def run(self, *arguments):
        command = [self.tilth, *[str(a) for a in arguments]]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
        if done.returncode not in (0, 3):
            sys.exit(f"scripts/localization: {' '.join(command)} failed")

    def scene(self, scene, keys):
        """Name of the scene for the program, and its keys."""
        if scene != "doors":
            return scene, [*keys, *self.extra]
        world = self.work / "doors.sdf"
        if not world.exists():
            identical_doors(world)
        return str(world), [f"waypoints={DOORS}", *keys, *self.extra]

    def source(self, scene, keys):
        name, keys = self.scene(scene, keys)
        return f"sim://{name}?" + "&".join(keys)

    def folder(self, *words):
        return self.work / "_".join(word.replace("=", "") for word in (*words, *self.extra))

    def truth(self, scene, keys):
        """The sensor's way does not depend on its columns: few of them, and the truth is made in no time."""
        folder = self.folder("truth", scene, *keys)
        if not (folder / "truth.tum").exists():
            name, keys = self.scene(scene, [*keys])
            keys = [k for k in keys if not k.startswith("columns=")] + ["columns=16"]
            self.run("simulate", name, "--out", folder, "--quiet", *[w for k in keys for w in ("--set", k)])
        return Track(folder / "truth.tum")

    def map(self, scene, keys):
        """The map of a drive, its frame in the world, and the poses of the truth along it."""
        out = self.folder("map", scene, *keys)
        if not (out / "MAP").exists():
            self.run("run", self.source(scene, keys), "--out", out, "--save-map", out / "MAP", "--threads", 1,
                     "--quiet")
        stamps = [float(line.split()[0]) for line in open(out / "trajectory.tum", encoding="utf-8")]
        truth = self.truth(scene, keys)
        return out / "MAP", truth.at(stamps[0]), [truth.at(stamp) for stamp in stamps[::10]]

    def imported(self, place):
        """The map of the points of `place` alone."""
        cloud, out = place.parent / "cloud.pcd", place.parent / "IMPORTED"
        if not out.exists():
            self.run("map", "export", place, cloud)
            self.run("map", "import", cloud, "--out", out)
        return out

    def localized(self, out, source, place, *flags):
        """Rows of localization.csv."""
        if not (out / "report.html").exists():
            self.run("localize", source, "--map", place, "--out", out, "--threads", 1, "--quiet", *flags)
        with open(out / "localization.csv", encoding="utf-8") as table:
            return list(csv.DictReader(table))


def error_of(row, truth, T_world_map):
    """T_true_said of a row of localization.csv, or None where it has no pose."""
    if not row["x"]:
        return None
    T_map_lidar = Pose([float(row[k]) for k in "xyz"], [float(row[k]) for k in ("qx", "qy", "qz", "qw")])
    return (T_world_map.inverse() * truth.at(float(row["stamp"]))).inverse() * T_map_lidar


def is_right(error):
    return error.distance() < RIGHT and error.angle() < RIGHT_ANGLE

"""Drives through saved maps as a whole: how well they are tracked, and what comes of a robot that is carried away."""

import csv
import json
import math

from localization_bench import error_of, is_right, quantile, rms

INSIDE = 1.237, 14.449  # of the chi^2 of 6 degrees of freedom: 95 % of the NEES of consistent poses
#        scene       [m] jump, [s] when, of each once with the sensor covered for 5 s as well
CARRIED = [("office", jump, at) for jump in (5, 10, 20, 35, 50) for at in (20, 15)] + \
          [("hospital", jump, at) for jump, at in ((5, 13), (10, 14), (20, 16), (35, 12))] + \
          [("corridor", jump, at) for jump, at in ((5, 14), (20, 12))]
COVERED = 5.0  # [s]
SEEN = 6.0     # [s] that a drive goes on after it sees again


def covariance_of(row):
    """6 x 6 [rad^2, m^2], of a row of localization.csv."""
    axes = ("rx", "ry", "rz", "tx", "ty", "tz")
    upper = {(i, j): float(row[f"cov_{axes[i]}_{axes[j]}"]) for i in range(6) for j in range(i, 6)}
    return [[upper[min(i, j), max(i, j)] for j in range(6)] for i in range(6)]


def squared_by(covariance, error):
    """error^T covariance^-1 error, by Cholesky's factor."""
    n, factor, whitened = len(error), [[0.0] * len(error) for _ in error], []
    for i in range(n):
        for j in range(i + 1):
            rest = covariance[i][j] - sum(factor[i][k] * factor[j][k] for k in range(j))
            factor[i][j] = math.sqrt(rest) if i == j else rest / factor[j][j]
        whitened.append((error[i] - sum(factor[i][k] * whitened[k] for k in range(i))) / factor[i][i])
    return sum(value * value for value in whitened)


def cpu_of(folder):
    """[ms] of CPU a scan on the mean, reading it apart."""
    with open(folder / "scans.csv", encoding="utf-8") as table:
        values = [float(row["cpu_ms_register"]) for row in csv.DictReader(table)]
    return sum(values) / len(values)


def odometry(bench, scene, keys, truth_folder):
    """The same drive without a map: its error [m] with the best rigid alignment, and [ms] of CPU a scan."""
    out = bench.folder("odometry", scene, *keys)
    if not (out / "summary.json").exists():
        bench.run("run", bench.source(scene, keys), "--out", out, "--threads", 1, "--quiet")
    bench.run("evaluate", truth_folder / "truth.tum", out / "trajectory.tum", "--align", "se3", "--interpolate",
              "--json", out / "error.json")
    error = json.loads((out / "error.json").read_text(encoding="utf-8"))
    return error["ape"]["translation"]["rmse"], cpu_of(out)


def track(bench, scenes, world, seed, change):
    print("| scene | poses | RMSE in the map | odometry's own | NEES, mean | inside 95 % | CPU of odometry |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    for number, scene in enumerate(scenes):
        place, T_world_map, _ = bench.map(scene, ["seed=511", f"world_seed={world}"])
        keys = [f"seed={seed + number}", f"world_seed={world}", f"changed={change}"]
        truth, out = bench.truth(scene, keys), bench.folder("tracked", scene, *keys)
        rows = bench.localized(out, bench.source(scene, keys), place)
        known = [row for row in rows if row["x"]]
        errors = [error_of(row, truth, T_world_map) for row in known]
        nees = [squared_by(covariance_of(row), (*e.turn(), *e.t)) for row, e in zip(known, errors)]
        inside = sum(INSIDE[0] <= value <= INSIDE[1] for value in nees) / len(nees)
        own, cpu = odometry(bench, scene, keys, bench.folder("truth", scene, *keys))
        rmse = rms([error.distance() for error in errors])
        print(f"| {scene}, changed={change} | {len(known)} of {len(rows)} | {rmse:.4f} | {own:.4f} | "
              f"{sum(nees) / len(nees):.1f} | {100 * inside:.0f} % | {cpu_of(out) / cpu:.2f} |", flush=True)


def carry(rows, truth, T_world_map, at, sees):
    """Whether it was located before, seconds to the first scan that is not, seconds from when it sees to the first
    right place, and the scans that are located at false ones."""
    before, noticed, found, false = False, None, None, 0
    for row in rows:
        stamp = float(row["stamp"])
        if stamp < at:
            before = row["state"] == "located"
            continue
        if noticed is None and row["state"] != "located":
            noticed = stamp - at
        error = error_of(row, truth, T_world_map)
        if not error or row["state"] != "located":
            continue
        right = is_right(error)
        if right and found is None and stamp >= sees:
            found = stamp - sees
        false += not right and stamp > at + 1.0
    return before, noticed, found, false


def kidnap(bench, world, seed, change):
    print("| scene, at [s], before | jump [m] | covered [s] | noticed after [s] | found again after [s] | "
          "**false** scans |")
    print("|---|--:|--:|--:|--:|--:|")
    cases = [(*case, covered) for case in CARRIED for covered in (0.0, COVERED)]
    all_noticed, all_found, all_false = [], [], 0
    for number, (scene, jump, at, covered) in enumerate(cases):
        place, T_world_map, _ = bench.map(scene, ["seed=511", f"world_seed={world}"])
        keys = [f"seed={seed + number}", f"world_seed={world}", f"changed={change}", f"kidnap={at}",
                f"kidnap_jump={jump}", f"covered={covered:g}"]
        rows = bench.localized(bench.folder("kidnapped", scene, *keys), bench.source(scene, keys), place, "--max-scans",
                               round(10 * (at + covered + SEEN)))
        before, noticed, found, false = carry(rows, bench.truth(scene, keys), T_world_map, at, at + covered)
        texts = [f"{value:.1f}" if value is not None else "never" for value in (noticed, found)]
        place_before = "located" if before else "not located"
        print(f"| {scene}, {at}, {place_before} | {jump} | {covered:g} | {texts[0]} | {texts[1]} | **{false}** |",
              flush=True)
        all_noticed.append(math.inf if noticed is None else noticed)
        all_found.append(math.inf if found is None else found)
        all_false += false
    print(f"\n{len(cases)} cases: noticed within 1 s {sum(t <= 1 for t in all_noticed)}, found again within 5 s "
          f"{sum(t <= 5 for t in all_found)} (median {quantile(all_found, 0.5):.1f} s), {all_false} false scans")

"""Holds every statistic of `tilth evaluate` against evo (https://github.com/MichaelGrupp/evo) on many trajectory pairs.

Usage: compare_with_evo.py TILTH          (the program). Exit code 77: evo is missing and CI is not set.
"""

import copy
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    from evo import EvoException
    from evo.core import metrics, sync
    from evo.core.metrics import PoseRelation
    from evo.core.sync_method import SyncMethod
    from evo.core.units import Unit
    from evo.tools import file_interface
except ImportError as missing:
    print(f"the Python package evo is missing: {missing}")
    sys.exit(1 if os.environ.get("CI") == "true" else 77)

import trajectory_pairs  # noqa: E402  (after the check for evo, which brings numpy and scipy)

RELATIVE, ABSOLUTE = 1e-9, 1e-12
ALIGNMENTS = ["none", "origin", "se3", "sim3"]
STATISTICS = ["rmse", "mean", "median", "std", "min", "max", "sse"]
RELATIONS = {
    "translation": PoseRelation.translation_part,
    "rotation": PoseRelation.rotation_angle_deg,
    "full": PoseRelation.full_transformation,
}


def rpe_choices(pair, alignment):
    """Settings of RPE: evo's arguments and the command's. A rigid alignment leaves relative poses alone: one is enough."""
    frames, metres = (Unit.frames, "frames"), (Unit.meters, "m")
    choices = (
        (frames, 1, False, False),
        (frames, 5, False, False),
        (frames, 5, True, False),
        (metres, pair.metres, False, False),
        (metres, pair.metres, True, False),
        (metres, pair.metres, False, True),
        (metres, pair.metres, True, True),
    )
    for (unit, name), delta, all_pairs, from_truth in choices[:1] if alignment in ("origin", "se3") else choices:
        evo = dict(delta=delta, delta_unit=unit, all_pairs=all_pairs, pairs_from_reference=from_truth)
        flags = ["--rpe-delta", str(delta), "--rpe-unit", name]
        yield evo, flags + ["--all-pairs"] * all_pairs + ["--pairs-from-truth"] * from_truth


def read_with_evo(pair, truth_file, estimate_file):
    if pair.kitti:
        return tuple(file_interface.read_kitti_poses_file(str(f)) for f in (truth_file, estimate_file))
    read = file_interface.read_euroc_csv_trajectory if pair.euroc else file_interface.read_tum_trajectory_file
    truth, estimate = (read(str(f)) for f in (truth_file, estimate_file))
    method = SyncMethod.interpolation if pair.interpolate else SyncMethod.nearest_time
    return sync.associate_trajectories(
        truth, estimate, sync_method=method, max_diff=pair.max_dt, offset_2=pair.time_offset
    )


def align_with_evo(truth, estimate, alignment):
    aligned = copy.deepcopy(estimate)
    if alignment == "origin":
        aligned.align_origin(truth)
    elif alignment != "none":
        aligned.align(truth, correct_scale=alignment == "sim3")
    return aligned


def judge_with_evo(truth, estimate, make_metric):
    result = {}
    for name, relation in RELATIONS.items():
        metric = make_metric(relation)
        metric.process_data((truth, estimate))
        result[name] = metric.get_all_statistics()
        if name == "rotation":
            metric.change_unit(Unit.radians)
            result["rotation_rad"] = metric.get_all_statistics()
    return result


def judge_with_tilth(program, pair, files, flags):
    command = [program, "evaluate", *map(str, files), "--max-dt", str(pair.max_dt)]
    command += ["--time-offset", str(pair.time_offset)] + ["--interpolate"] * pair.interpolate
    report = files[0].with_name("report.json")
    report.unlink(missing_ok=True)
    run = subprocess.run(command + flags + ["--json", str(report)], capture_output=True, text=True)
    if run.returncode != 0:
        assert run.stderr.startswith("tilth: error: "), run.stderr
        return None
    return json.loads(report.read_text())


class Comparison:
    def __init__(self):
        self.compared = self.refused = 0
        self.worst, self.failures = 0.0, []

    def compare(self, what, ours, theirs):
        for name in theirs:
            for statistic in STATISTICS:
                a, b = ours[name][statistic], float(theirs[name][statistic])
                self.compared += 1
                difference = abs(a - b)
                if difference > ABSOLUTE:
                    self.worst = max(self.worst, difference / abs(b) if b else float("inf"))
                if not (difference <= ABSOLUTE or difference <= RELATIVE * abs(b)):
                    self.failures.append(f"{what}, {name} {statistic}: {a!r}, evo {b!r}")

    def compare_refusal(self, what, ours, evo_refuses):
        self.refused += 1
        if ours is not None:
            self.failures.append(f"{what}: should be refused" + (", as by evo" if evo_refuses else ""))


def compare_alignment(program, pair, files, matches, alignment, comparison):
    flags = ["--align", alignment]
    try:
        truth, estimate = matches[0], align_with_evo(*matches, alignment)
        ape = judge_with_evo(truth, estimate, metrics.APE)
    except EvoException:
        ape = None
    for settings, rpe_flags in rpe_choices(pair, alignment):
        what = f"{pair.name}, align {alignment}, {' '.join(rpe_flags)}"
        ours = judge_with_tilth(program, pair, files, flags + rpe_flags)
        if ape is None or alignment in pair.own_refusals:
            comparison.compare_refusal(what, ours, ape is None)
            return
        try:
            rpe = judge_with_evo(truth, estimate, lambda relation: metrics.RPE(relation, **settings))
        except EvoException:
            comparison.compare_refusal(what, ours, True)
            continue
        if ours is None:
            comparison.failures.append(f"{what}: refused, but not by evo")
            continue
        comparison.compare(what + ", APE", ours["ape"], ape)
        comparison.compare(what + ", RPE", ours["rpe"], rpe)
        if ours["matches"] != truth.num_poses:
            comparison.failures.append(f"{what}: {ours['matches']} matches, evo {truth.num_poses}")


def main(program):
    comparison = Comparison()
    pairs = trajectory_pairs.all_pairs()
    with tempfile.TemporaryDirectory() as folder:
        files = Path(folder, "truth.txt"), Path(folder, "estimate.txt")
        for pair in pairs:
            trajectory_pairs.write(files[0], pair.truth, pair)
            trajectory_pairs.write(files[1], pair.estimate, pair)
            matches = read_with_evo(pair, *files)
            for alignment in ALIGNMENTS:
                compare_alignment(program, pair, files, matches, alignment, comparison)
    for failure in comparison.failures:
        print("DIFFERS:", failure)
    print(
        f"{len(pairs)} pairs, {comparison.compared} statistics compared, {comparison.refused} refusals, "
        f"largest relative difference {comparison.worst:.1e}, {len(comparison.failures)} failures"
    )
    return 1 if comparison.failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

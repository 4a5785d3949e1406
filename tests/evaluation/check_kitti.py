"""Holds `tilth evaluate --kitti` against two others: KISS-ICP's port of the KITTI development kit (package kiss-icp), and
the kit's definition written out below, which also gives the number of segments and the means of each length.

The definition (A. Geiger et al., CVPR 2012; the kit's readme): with d_k the length of the true path up to pose k, a
segment of L = 100, 200 ... 800 m begins at every tenth pose i and ends at the first j with d_j > d_i + L, where there is
one. Its error is E = (E_i^-1 E_j)^-1 (T_i^-1 T_j) of estimate E and truth T: |t(E)| / L, and the angle of E over L. The
score is the mean over all segments. A truth of the camera is judged by the calibration beside it, at the camera.

Usage: check_kitti.py TILTH
"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs  # noqa: E402

np, kiss, transform = needs("numpy", "kiss_icp.metrics", "scipy.spatial.transform")
import trajectory_pairs  # noqa: E402

LENGTHS = range(100, 900, 100)
T_CAMERA_LIDAR = np.eye(4)
T_CAMERA_LIDAR[:3, :3] = [[0, -1, 0], [0, 0, -1], [1, 0, 0]]
T_CAMERA_LIDAR[:3, :3] = transform.Rotation.from_rotvec([0.01, -0.02, 0.03]).as_matrix() @ T_CAMERA_LIDAR[:3, :3]
T_CAMERA_LIDAR[:3, 3] = [0.1, -0.2, -0.3]


def matrices(trajectory):
    poses = np.tile(np.eye(4), (len(trajectory), 1, 1))
    poses[:, :3, :3] = transform.Rotation.from_quat(trajectory[:, 4:]).as_matrix()
    poses[:, :3, 3] = trajectory[:, 1:4]
    return poses


def angle(R):
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return np.arctan2(np.linalg.norm(axis), np.trace(R) - 1)


def segments(truth, estimate):
    """Rows (length, translation error, rotation error [rad]) per metre."""
    path = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1))])
    rows = []
    for first in range(0, len(truth), 10):
        for length in LENGTHS:
            beyond = np.nonzero(path > path[first] + length)[0]
            if not len(beyond):
                continue
            last = beyond[0]
            motion = np.linalg.inv(truth[first]) @ truth[last]
            E = np.linalg.inv(np.linalg.inv(estimate[first]) @ estimate[last]) @ motion
            rows.append((length, np.linalg.norm(E[:3, 3]) / length, angle(E[:3, :3]) / length))
    return np.array(rows)


def in_camera_frame(poses):
    """KITTI's own truth: of the camera, its world turned alike."""
    return T_CAMERA_LIDAR @ poses @ np.linalg.inv(T_CAMERA_LIDAR)


def judged(program, pair, folder, camera=False):
    files = [folder / "truth.txt", folder / "estimate.txt"]
    trajectory_pairs.write(files[0], pair.truth, pair)
    trajectory_pairs.write(files[1], pair.estimate, pair)
    (folder / "calib.txt").unlink(missing_ok=True)
    if camera:
        np.savetxt(files[0], in_camera_frame(matrices(pair.truth))[:, :3].reshape(-1, 12), fmt="%.17g")
        numbers = " ".join(repr(float(x)) for x in T_CAMERA_LIDAR[:3].ravel())
        (folder / "calib.txt").write_text(f"P0: 7 0 6 0 0 7 1 0 0 0 1 0\nTr: {numbers}\n")
    command = [program, "evaluate", *map(str, files), "--kitti", "--json", str(folder / "report.json")]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "report.json").read_text())["kitti"]


def close(what, ours, theirs, relative):
    assert abs(ours - theirs) <= relative * abs(theirs) + 1e-12, f"{what}: {ours!r}, the other {theirs!r}"


def check(program, pair, folder, camera=False):
    ours, truth, estimate = judged(program, pair, folder, camera), matrices(pair.truth), matrices(pair.estimate)
    if camera:  # as the benchmark measures: at the camera
        truth, estimate = in_camera_frame(truth), in_camera_frame(estimate)
    rows = segments(truth, estimate)
    assert ours["segments"] == len(rows), f"{pair.name}: {ours['segments']} segments, not {len(rows)}"
    close(pair.name, ours["translation_percent"], 100 * rows[:, 1].mean(), 1e-9)
    close(pair.name, ours["rotation_deg_per_m"], np.degrees(rows[:, 2].mean()), 1e-9)
    assert [row["length"] for row in ours["by_length"]] == sorted(set(rows[:, 0]))
    for row in ours["by_length"]:
        mean = rows[rows[:, 0] == row["length"]].mean(axis=0)
        close(f"{pair.name}, {row['length']} m", row["translation_percent"], 100 * mean[1], 1e-9)
        close(f"{pair.name}, {row['length']} m", row["rotation_deg_per_m"], np.degrees(mean[2]), 1e-9)
    percent, degrees = kiss.sequence_error(truth, estimate)
    close(pair.name + ", KISS-ICP", ours["translation_percent"], percent, 1e-6)
    degrees *= 3.14 / np.pi  # its degrees are 180 / 3.14 to the radian
    close(pair.name + ", KISS-ICP", ours["rotation_deg_per_m"], degrees, 1e-6)
    return len(rows)


def pairs():
    rng, made = np.random.default_rng(20261122), trajectory_pairs
    street = made.walk(rng, 1500, step=1.0, turn=0.01)
    curves = made.walk(rng, 900, step=0.7, turn=0.1)
    short = made.walk(rng, 140, step=1.0, turn=0.01)
    return [
        made.Pair("street", street, made.drifting(rng, street)),
        made.Pair("street as KITTI files", street, made.drifting(rng, street), kitti=True),
        made.Pair("street, noise", street, made.noisy(rng, street)),
        made.Pair("curves, another frame", curves, made.moved(made.drifting(rng, curves), [0.4, -1, 2], [30, -20, 5])),
        made.Pair("one length", short, made.drifting(rng, short)),
    ]


with tempfile.TemporaryDirectory() as name:
    count = [check(sys.argv[1], pair, pathlib.Path(name)) for pair in pairs()]
    count.append(check(sys.argv[1], pairs()[0], pathlib.Path(name), camera=True))
print(f"{len(count)} pairs, {sum(count)} segments agree with the definition and with KISS-ICP")

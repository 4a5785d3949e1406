"""Simulated PCD files as PCL (https://pointclouds.org) reads and writes them, by its program pcl_convert_pcd_ascii_binary.

Usage: check_pcl.py TILTH FORMAT_PROBE
"""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs, needs_program  # noqa: E402

(numpy,) = needs("numpy")
CONVERT = needs_program("pcl_convert_pcd_ascii_binary", "pcl-tools")
TILTH, PROBE = sys.argv[1:3]
FIELDS = ["x", "y", "z", "intensity", "ring", "time"]
ASCII, COMPRESSED = "0", "2"


def run(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert done.returncode == 0, (command, done.stdout, done.stderr)
    return done.stdout + done.stderr  # PCL talks on either


def header_of(path):
    lines = path.read_bytes()[:600].split(b"\n")
    return {line.split()[0].decode(): line.split()[1:] for line in lines[1:11]}


def bytes_of(path):
    """The points of a binary PCD file, read by its header alone."""
    header = header_of(path)
    kinds = {(b"F", b"4"): "<f4", (b"U", b"2"): "<u2", (b"U", b"1"): "u1", (b"F", b"8"): "<f8"}
    names = [name.decode() for name in header["FIELDS"]]
    kind = [(name, kinds[key]) for name, key in zip(names, zip(header["TYPE"], header["SIZE"]))]
    data = path.read_bytes()
    start = data.index(b"DATA binary\n") + len(b"DATA binary\n")
    return numpy.frombuffer(data, kind, count=int(header["POINTS"][0]), offset=start)


def check_scan(path, folder):
    written = bytes_of(path)
    assert len(written) > 5000 and list(written.dtype.names) == FIELDS
    said = run(CONVERT, path, folder / "ascii.pcd", ASCII, "9")
    assert f"with {len(written)} points" in said, said
    read = numpy.loadtxt(folder / "ascii.pcd", skiprows=11)
    assert read.shape == (len(written), len(FIELDS)), read.shape
    for column, name in enumerate(FIELDS):
        values = read[:, column].astype(written.dtype[name])
        numpy.testing.assert_array_equal(values, written[name], f"{path.name} {name}")
    run(CONVERT, path, folder / "compressed.pcd", COMPRESSED)
    assert b"DATA binary_compressed" in (folder / "compressed.pcd").read_bytes()[:600]
    names, *rows = run(PROBE, "dump", folder / "compressed.pcd").splitlines()
    assert names.split() == FIELDS, names
    back = numpy.array([[float(word) for word in row.split()] for row in rows])
    for column, name in enumerate(FIELDS):
        numpy.testing.assert_array_equal(back[:, column], written[name].astype("f8"), f"compressed {name}")
    return len(written)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    run(TILTH, "simulate", "hospital", "--out", folder / "made", "--duration", "0.4", "--set", "columns=600", "--quiet")
    scans = sorted((folder / "made" / "scans").glob("*.pcd"))
    assert len(scans) == 3, scans
    points = sum(check_scan(scan, folder) for scan in scans)
print(f"{len(scans)} scans, {points} points: PCL reads what was written, and what PCL writes is read")

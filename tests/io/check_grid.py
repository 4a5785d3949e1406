"""Maps for robots that tilth run writes: the floor plan by Pillow and PyYAML, the OctoMap by octomap-tools, the tiles by
pypcd4, each held against map.pcd of the same run. Argument: the program tilth."""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from needs import needs, needs_program  # noqa: E402

numpy, pil, yaml, pypcd4 = needs("numpy", "PIL", "yaml", "pypcd4")
from PIL import Image  # noqa: E402

TILTH = sys.argv[1]
SCENE = "sim://corridor?duration=20&seed=4&sensor=vlp16"
RESOLUTION = 0.2
FREE, OCCUPIED, UNKNOWN = 254, 0, 205


def run(out, *arguments):
    done = subprocess.run([TILTH, "run", SCENE, "--out", out, "--quiet", *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def points_of(path):
    return pypcd4.PointCloud.from_path(path).numpy(("x", "y", "z"))


def check_plan(folder, points):
    meta = yaml.safe_load((folder / "map.yaml").read_text())
    assert {key: meta[key] for key in ("image", "mode", "negate")} == {"image": "map.pgm", "mode": "trinary", "negate": 0}
    assert meta["free_thresh"] < meta["occupied_thresh"] and meta["origin"][2] == 0
    image = numpy.array(Image.open(folder / meta["image"]))
    assert set(numpy.unique(image)) == {FREE, OCCUPIED, UNKNOWN}
    # as map_server does: darkness is occupancy
    occupancy = (255 - image.astype(float)) / 255
    assert (occupancy[image == FREE] < meta["free_thresh"]).all()
    assert (occupancy[image == OCCUPIED] > meta["occupied_thresh"]).all()
    assert ((occupancy[image == UNKNOWN] > meta["free_thresh"]) & (occupancy[image == UNKNOWN] < meta["occupied_thresh"])).all()
    poses = numpy.loadtxt(folder / "trajectory.tum")

    def cells(places):
        column, row = numpy.floor((places[:, :2] - meta["origin"][:2]) / meta["resolution"]).astype(int).T
        return image[image.shape[0] - 1 - row, column]

    assert (cells(poses[:, 1:4]) == FREE).all()
    near = numpy.linalg.norm(points[:, :2], axis=1) < 20
    walls = points[near & (points[:, 2] > -0.5) & (points[:, 2] < 0.9)]
    assert (cells(walls) == OCCUPIED).mean() > 0.95, (cells(walls) == OCCUPIED).mean()


def check_octomap(folder, points):
    convert = needs_program("convert_octree", "octomap-tools")
    vrml = needs_program("bt2vrml", "octomap-tools")
    done = subprocess.run([convert, folder / "map.bt", folder / "map.ot"], capture_output=True, text=True)
    assert done.returncode == 0 and (folder / "map.ot").stat().st_size > 1000, done.stderr
    header = (folder / "map.ot").read_bytes()[:400].decode(errors="replace")
    assert f"res {RESOLUTION}" in header and "id OcTree" in header, header
    done = subprocess.run([vrml, folder / "map.bt"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    text = (folder / "map.bt.wrl").read_text()
    boxes = [line for line in text.splitlines() if "translation" in line]
    places = numpy.array([[float(v) for v in line.split("translation")[1].split()[:3]] for line in boxes])
    mine = {tuple(cell) for cell in numpy.floor(points / RESOLUTION).astype(int)}
    theirs = {tuple(cell) for cell in numpy.floor(places / RESOLUTION).astype(int)}
    assert len(theirs - mine) <= 0.001 * len(mine), (len(mine), len(theirs))
    assert len(mine - theirs) < 0.4 * len(mine)  # eight that are alike are written as one larger box


def check_tiles(folder, points):
    meta = yaml.safe_load((folder / "pointcloud_map_metadata.yaml").read_text())
    assert (meta.pop("x_resolution"), meta.pop("y_resolution")) == (5.0, 5.0)
    assert set(meta) == {path.name for path in (folder / "pointcloud_map").iterdir()} and len(meta) > 3
    total = 0
    for name, (x, y) in meta.items():
        tile = points_of(folder / "pointcloud_map" / name)
        assert (tile[:, 0] >= x).all() and (tile[:, 0] <= x + 5).all() and (tile[:, 1] >= y).all() and (tile[:, 1] <= y + 5).all()
        total += len(tile)
    assert total == len(points)


with tempfile.TemporaryDirectory() as name:
    out = pathlib.Path(name) / "run"
    (out / "pointcloud_map").mkdir(parents=True)
    (out / "pointcloud_map" / "0_0_old.pcd").write_text("of an earlier run")
    run(out, "--grid", "--map-format", "pcd,bt,tiles", "--octomap-resolution", str(RESOLUTION), "--tile", "5")
    whole = points_of(out / "map.pcd")
    check_plan(out, whole)
    check_tiles(out, whole)
    check_octomap(out, whole)
print("the floor plan, the OctoMap and the tiles are what other programs read")

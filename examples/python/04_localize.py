"""Two drives through one building: the first makes a map, the second is found in it. Argument: folder for the map."""

import sys

import tilth

slam = tilth.Slam()
for scan in tilth.simulate("office", seed=1, world_seed=7, duration=15, columns=600):
    slam.register_scan(scan)
slam.save_map(sys.argv[1])

localizer = tilth.Localizer(sys.argv[1])
for scan in tilth.simulate("office", seed=2, world_seed=7, duration=6, columns=600):
    located = localizer.add(scan)
    if located.T_map_lidar is not None:
        x, y = located.T_map_lidar[:2, 3]
        print(f"{located.stamp:.2f} s: {located.state} at {x:.3f} {y:.3f}, {100 * located.overlap:.0f} % on the map")

// A scan as patches of surface: the runs of each beam, with the shape that the beams above and below give them. A
// single beam draws a line on whatever it meets, and a line that travels with the sensor says nothing true about the
// surface: only runs of neighbouring beams that lie in one plane make a patch with a normal. O(n).
#pragma once

#include <tilth/core/flatness.hpp>
#include <tilth/core/surface_patch.hpp>
#include <tilth/features/ring_segments.hpp>

namespace tilth {

struct PatchOptions {
  SegmentOptions segments = {};
  double max_thickness = kFlatThickness;
  double max_misfit = 1e6;
  double roughness = 0.002;
  double max_gap = 0.3;
  double max_gap_ratio = 0.06;
  double pole_width = 0.6;
};

template <class V>
void visit(PatchOptions& o, V&& v) {
  v("segments", o.segments, "[-] the runs of each beam");
  v("max_thickness", o.max_thickness, Bounds{0.001, 1}, "[m] standard deviation from the plane of a flat patch");
  v("max_misfit", o.max_misfit, Bounds{0, 1e9},
    "[sigma] by which three runs may miss their plane together, as the points of each scatter about it: more is a "
    "corner, not a plane");
  v("roughness", o.roughness, Bounds{0, 1}, "[m] that they may miss it by in addition");
  v("max_gap", o.max_gap, Bounds{0.01, 10},
    "[m] between two beams that make a patch where there is no third in the same plane, at least");
  v("max_gap_ratio", o.max_gap_ratio, Bounds{0, 1}, "[-] the same as a share of the range");
  v("pole_width", o.pole_width, Bounds{0, 10}, "[m] a run that stands free and is narrower is part of a pole");
}

/// The patches of a scan, ring by ring; of a cloud without rings from neighbourhoods (neighborhood_patches.hpp). Runs
/// that no beam beside belongs to are left out. `rings` is the layout of `cloud`; points whose entry in `keep`, one a
/// point, is zero are passed over.
SurfacePatches surface_patches(const PointCloud& cloud, const RingLayout& rings, std::span<const std::uint8_t> keep,
                               const PatchOptions& options);

/// The same of all points.
SurfacePatches surface_patches(const PointCloud& cloud, const PatchOptions& options);

}  // namespace tilth

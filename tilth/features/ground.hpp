// Ground and clusters in a range image: LeGO-LOAM (Shan and Englot 2018, section III-B; angle criterion of Bogoslavskyi
// and Stachniss 2016). O(cells).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/features/range_image.hpp>

namespace tilth {

struct GroundOptions {
  int rows = 7;
  double max_slope = 10.0;
  double mount_angle = 0.0;
};

template <class V>
void visit(GroundOptions& o, V&& v) {
  v("rows", o.rows, Bounds{0, 1023}, "[-] ground is looked for between each of so many lowest beams and the next");
  v("max_slope", o.max_slope, Bounds{0, 90}, "[deg] between the points of two beams on the ground");
  v("mount_angle", o.mount_angle, Bounds{-90, 90}, "[deg] slope that level ground has in the sensor's frame");
}

/// 1 for each cell on the ground, else 0. A cell and the one above it are ground where the line between their points
/// is no steeper than allowed; a cell whose pair is not complete is no ground, even if the pair below it said so.
std::vector<std::uint8_t> mark_ground(const PointCloud& cloud, const RangeImage& image, const GroundOptions& options);

struct ClusterOptions {
  double min_angle = 60.0;
  int min_cells = 30;
  int min_cells_on_rows = 5;
  int min_rows = 3;
};

template <class V>
void visit(ClusterOptions& o, V&& v) {
  v("min_angle", o.min_angle, Bounds{0, 90},
    "[deg] between the farther beam and the line to the nearer point, of neighbours on one surface");
  v("min_cells", o.min_cells, Bounds{1, 1e6}, "[cells] of a cluster that is kept");
  v("min_cells_on_rows", o.min_cells_on_rows, Bounds{1, 1e6}, "[cells] of one that lies on min_rows, likewise");
  v("min_rows", o.min_rows, Bounds{1, 1024},
    "[-] rows of such a cluster; the row of the first cell only counts where the cluster comes back to it");
}

/// What a cell belongs to.
enum class CellLabel : std::uint8_t { empty, ground, cluster, noise };

/// Cells joined with their four neighbours (columns go round, rows do not) where the surface goes on, by min_angle;
/// `row_step` [deg] lies between two beams. Clusters with too few cells are noise.
std::vector<CellLabel> cluster(const RangeImage& image, std::span<const std::uint8_t> ground, double row_step,
                               const ClusterOptions& options);

}  // namespace tilth

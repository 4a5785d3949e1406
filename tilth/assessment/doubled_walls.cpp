#include <algorithm>
#include <map>

#include <tilth/assessment/doubled_walls.hpp>
#include <tilth/assessment/layer_split.hpp>
#include <tilth/core/voxel_table.hpp>

namespace tilth {
namespace {

constexpr float kCell = 0.8F;      // [m]
constexpr float kFarthest = 1e5F;  // [m]

struct WallCell {
  Eigen::Vector3i place;
  std::vector<ScannedPoint> points;
};

std::vector<WallCell> cells_of(std::span<const ScannedPoint> points, float shift) {
  VoxelTable table;
  std::vector<WallCell> cells;
  for (const ScannedPoint& p : points) {
    if (!(p.point.cwiseAbs().maxCoeff() < kFarthest)) continue;
    const Eigen::Vector3i place = voxel_of((p.point.array() / kCell + shift).matrix().cast<double>());
    const std::uint32_t number = table.insert(voxel_key(place, 0));
    if (number == cells.size()) cells.push_back({place, {}});
    cells[number].points.push_back(p);
  }
  return cells;
}

/// Puts cells together that touch one another: each wall is where its first cell is, with the mean of their gaps.
class Joined {
 public:
  void add(const Eigen::Vector3i& place, const DoubledWall& wall) { open_[{place.x(), place.y(), place.z()}] = wall; }

  std::vector<DoubledWall> walls() {
    std::vector<DoubledWall> all;
    while (!open_.empty()) all.push_back(next());
    std::stable_sort(all.begin(), all.end(),
                     [](const DoubledWall& a, const DoubledWall& b) { return a.cells > b.cells; });
    return all;
  }

 private:
  using Key = std::array<int, 3>;

  DoubledWall next() {
    std::vector<Key> reached{open_.begin()->first};
    DoubledWall wall = open_.begin()->second;
    open_.erase(open_.begin());
    double gaps = wall.gap;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (int k = 0; k < 27; ++k) {
        const Key beside{reached[i][0] + k % 3 - 1, reached[i][1] + k / 3 % 3 - 1, reached[i][2] + k / 9 - 1};
        const auto found = open_.find(beside);
        if (found == open_.end()) continue;
        gaps += found->second.gap;
        reached.push_back(beside);
        open_.erase(found);
      }
    }
    wall.cells = reached.size();
    wall.gap = gaps / double(reached.size());
    return wall;
  }

  std::map<Key, DoubledWall> open_;
};

/// In a grid shifted by a share of a cell.
DoubledWalls found_in_grid(std::span<const ScannedPoint> points, float shift) {
  DoubledWalls found;
  Joined joined;
  for (const WallCell& cell : cells_of(points, shift)) {
    const CellLayers layers = layers_of(cell.points);
    if (layers.planar) ++found.planes;
    if (!layers.doubled) continue;
    ++found.doubled;
    joined.add(cell.place, *layers.doubled);
  }
  found.walls = joined.walls();
  return found;
}

}  // namespace

DoubledWalls doubled_walls(std::span<const ScannedPoint> points) {
  DoubledWalls found = found_in_grid(points, 0), shifted = found_in_grid(points, 0.5F);
  return shifted.doubled > found.doubled ? shifted : found;
}

}  // namespace tilth

#include <algorithm>
#include <unordered_map>

#include <tilth/core/voxel_table.hpp>
#include <tilth/freespace/changes.hpp>

namespace tilth {
namespace {

constexpr float kCell = 0.3F;        // [m] points in cells that touch may be of one thing
constexpr std::size_t kFewest = 15;  // points of a thing
constexpr float kLeastSize = 0.25F;  // [m] longest edge of its box
constexpr double kTogether = 1.0;    // [s] that stays may lie apart and still be of one thing
constexpr int kNeighbours = 27;

using Cells = std::unordered_map<std::int64_t, std::vector<std::uint32_t>>;

Eigen::Vector3i cell_of(const Eigen::Vector3f& point) {
  return voxel_of((point / kCell).cast<double>());
}

bool together(const Stay& a, const Stay& b) {
  return a.kind == b.kind && a.first_seen <= b.last_seen + kTogether && b.first_seen <= a.last_seen + kTogether;
}

void take(Change& change, const ChangedPoint& p) {
  change.box.extend(p.point);
  change.stay.first_seen = std::min(change.stay.first_seen, p.stay.first_seen);
  change.stay.last_seen = std::max(change.stay.last_seen, p.stay.last_seen);
  ++change.points;
}

/// Takes all points from the cells that hang together with the one given.
Change grown_from(std::uint32_t seed, std::span<const ChangedPoint> points, Cells& cells) {
  Change change{points[seed].stay, {}, 0};
  std::vector<std::uint32_t> open{seed};
  while (!open.empty()) {
    const ChangedPoint& p = points[open.back()];
    open.pop_back();
    take(change, p);
    const Eigen::Vector3i cell = cell_of(p.point);
    for (int i = 0; i < kNeighbours; ++i) {
      const auto found = cells.find(voxel_key(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), 0));
      if (found == cells.end()) continue;
      std::erase_if(found->second, [&](std::uint32_t n) {
        if (!together(points[n].stay, p.stay)) return false;
        open.push_back(n);
        return true;
      });
    }
  }
  return change;
}

double time_of(const Change& change) {
  return change.stay.kind == ChangeKind::left ? change.stay.last_seen : change.stay.first_seen;
}

}  // namespace

std::string_view name_of(ChangeKind kind) {
  return kind == ChangeKind::left ? "left" : "came";
}

std::vector<Change> changes_of(std::span<const ChangedPoint> points) {
  Cells cells;
  for (std::uint32_t i = 0; i < points.size(); ++i) cells[voxel_key(cell_of(points[i].point), 0)].push_back(i);
  std::vector<Change> changes;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::vector<std::uint32_t>& own = cells[voxel_key(cell_of(points[i].point), 0)];
    if (std::erase(own, i) == 0) continue;  // taken already
    const Change change = grown_from(i, points, cells);
    if (change.points >= kFewest && change.box.sizes().maxCoeff() >= kLeastSize) changes.push_back(change);
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return time_of(a) < time_of(b); });
  return changes;
}

}  // namespace tilth

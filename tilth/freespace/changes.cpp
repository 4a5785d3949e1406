#include <algorithm>
#include <unordered_map>

#include <tilth/core/voxel_table.hpp>
#include <tilth/freespace/changes.hpp>

namespace tilth {
namespace {

constexpr float kCell = 0.3F;        // [m] points in cells that touch may be of one thing
constexpr std::size_t kFewest = 15;  // points of a thing
constexpr float kLeastSize = 0.25F;  // [m] longest edge of its box
constexpr int kNeighbours = 27;
constexpr double kMostLater = 0.25;  // of what came: points that beams passed after the first of it was seen

using Cells = std::unordered_map<std::int64_t, std::vector<std::uint32_t>>;

Eigen::Vector3i cell_of(const Eigen::Vector3f& point) {
  return voxel_of((point / kCell).cast<double>());
}

bool together(const Stay& a, const Stay& b, double apart) {
  return a.kind == b.kind && a.first_seen <= b.last_seen + apart && b.first_seen <= a.last_seen + apart;
}

void take(Change& change, const ChangedPoint& p) {
  change.box.extend(p.point);
  change.stay.first_seen = std::min(change.stay.first_seen, p.stay.first_seen);
  change.stay.last_seen = std::max(change.stay.last_seen, p.stay.last_seen);
  ++change.points;
}

/// Takes the numbers of all points from the cells that hang together with the one given.
std::vector<std::uint32_t> grown_from(std::uint32_t seed, std::span<const ChangedPoint> points, double apart,
                                      Cells& cells) {
  std::vector<std::uint32_t> numbers{seed};
  for (std::size_t next = 0; next < numbers.size(); ++next) {
    const ChangedPoint& p = points[numbers[next]];
    const Eigen::Vector3i cell = cell_of(p.point);
    for (int i = 0; i < kNeighbours; ++i) {
      const auto found = cells.find(voxel_key(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), 0));
      if (found == cells.end()) continue;
      std::erase_if(found->second, [&](std::uint32_t n) {
        if (!together(points[n].stay, p.stay, apart)) return false;
        numbers.push_back(n);
        return true;
      });
    }
  }
  return numbers;
}

/// Whether what came was there at once: where all of it is, beams passed until the first of it was seen, and not later.
bool came_at_once(std::span<const std::uint32_t> numbers, std::span<const ChangedPoint> points, double apart) {
  std::vector<double> seen;
  for (const std::uint32_t n : numbers) seen.push_back(points[n].stay.first_seen);
  const auto early = seen.begin() + std::ptrdiff_t(seen.size() / 10);
  std::nth_element(seen.begin(), early, seen.end());
  const auto later = std::count_if(numbers.begin(), numbers.end(),
                                   [&](std::uint32_t n) { return points[n].stay.free_until > *early + apart; });
  return double(later) < kMostLater * double(numbers.size());
}

Change change_of(std::span<const std::uint32_t> numbers, std::span<const ChangedPoint> points) {
  Change change{points[numbers.front()].stay, {}, 0};
  for (const std::uint32_t n : numbers) take(change, points[n]);
  return change;
}

bool is_thing(const Change& change) {
  return change.points >= kFewest && change.box.sizes().maxCoeff() >= kLeastSize;
}

double time_of(const Change& change) {
  return change.stay.kind == ChangeKind::left ? change.stay.last_seen : change.stay.first_seen;
}

}  // namespace

std::string_view name_of(ChangeKind kind) {
  return kind == ChangeKind::left ? "left" : "came";
}

std::vector<Change> changes_of(std::span<const ChangedPoint> points, double apart) {
  Cells cells;
  for (std::uint32_t i = 0; i < points.size(); ++i) cells[voxel_key(cell_of(points[i].point), 0)].push_back(i);
  std::vector<Change> changes;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::vector<std::uint32_t>& own = cells[voxel_key(cell_of(points[i].point), 0)];
    if (std::erase(own, i) == 0) continue;  // taken already
    const std::vector<std::uint32_t> numbers = grown_from(i, points, apart, cells);
    const Change change = change_of(numbers, points);
    const bool left = change.stay.kind == ChangeKind::left;
    if (is_thing(change) && (left || came_at_once(numbers, points, apart))) changes.push_back(change);
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return time_of(a) < time_of(b); });
  return changes;
}

}  // namespace tilth

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <tilth/core/error.hpp>
#include <tilth/core/evenly_chosen.hpp>
#include <tilth/core/parallel.hpp>
#include <tilth/localization/place_search.hpp>

namespace tilth {
namespace {

constexpr int kYaws = 128, kCoarseYaws = 2;     // steps of a turn, and every how many-th the coarse search takes
constexpr std::int32_t kStride = 2;             // [cells] of the coarse search
constexpr std::int64_t kMostCells = 1LL << 28;  // of a grid
constexpr double kPromising = 0.45;             // share of the points that must be found in the coarse search

Eigen::Matrix3d turned(int yaw) {
  return Eigen::AngleAxisd(2 * std::numbers::pi * yaw / kYaws, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

std::uint8_t turned_facings(std::uint8_t facings, int by) {
  const unsigned both = unsigned(facings) << 8 | facings;
  return std::uint8_t(both >> (kUprightFacings - by));
}

/// The patches that stand upright, one a cell and facing, at most so many, evenly.
SurfacePatches compared(const SurfacePatches& patches, const PlaceSearchOptions& options) {
  std::set<std::array<int, 3>> seen;
  SurfacePatches kept;
  for (const SurfacePatch& patch : patches) {
    if (!stands_upright(patch) || patch.mean.head<2>().norm() > options.range) continue;
    if (seen.insert({upright_cell_of(patch.mean.x()), upright_cell_of(patch.mean.y()), facings_of(patch)}).second)
      kept.push_back(patch);
  }
  return evenly_chosen<SurfacePatch>(kept, std::size_t(options.max_points));
}

int yaws_apart(int a, int b) {
  const int apart = std::abs(a - b) % kYaws;
  return std::min(apart, kYaws - apart);
}

/// Best first; those beside a better one go.
template <class Peaks>
Peaks best_of(Peaks peaks, std::size_t most, int cells, int yaws) {
  std::stable_sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  Peaks best;
  for (const auto& p : peaks) {
    const auto beside = [&](const auto& b) {
      return std::abs(b.x - p.x) <= cells && std::abs(b.y - p.y) <= cells && yaws_apart(b.yaw, p.yaw) <= yaws;
    };
    if (std::none_of(best.begin(), best.end(), beside)) best.push_back(p);
    if (best.size() == most) break;
  }
  return best;
}

}  // namespace

PlaceSearch::PlaceSearch(const PlaceMap& map, const PlaceSearchOptions& options) : map_(map), options_(options) {
  draw_grids();
  find_free_ground();
}

void PlaceSearch::draw_grids() {
  const std::vector<UprightCell>& cells = map_.uprights();
  if (cells.empty()) return;
  std::int32_t high_x = cells[0].x, high_y = cells[0].y;
  low_x_ = high_x, low_y_ = high_y;
  for (const UprightCell& c : cells) {
    low_x_ = std::min(low_x_, c.x), high_x = std::max(high_x, c.x);
    low_y_ = std::min(low_y_, c.y), high_y = std::max(high_y, c.y);
  }
  low_x_ -= 2, low_y_ -= 2;
  const std::int64_t width = std::int64_t(high_x) + 3 - low_x_, height = std::int64_t(high_y) + 3 - low_y_;
  if (width * height > kMostCells) {
    throw Error("map", "spans " + std::to_string(width * height) + " cells, expected at most " +
                           std::to_string(kMostCells) + " (8 km squared)");
  }
  width_ = std::int32_t(width), height_ = std::int32_t(height);
  exact_.assign(std::size_t(width * height), 0), near_ = exact_;
  for (const UprightCell& c : cells) {
    exact_[index(c.x, c.y)] = c.facings;
    const auto beside =
        std::uint8_t(c.facings | turned_facings(c.facings, 1) | turned_facings(c.facings, kUprightFacings - 1));
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) near_[index(c.x + dx, c.y + dy)] |= beside;
  }
}

void PlaceSearch::find_free_ground() {
  std::set<std::pair<std::int32_t, std::int32_t>> taken;
  const auto reach = std::int32_t(std::ceil(options_.off_way / kUprightCell));
  for (const MapPlace& place : map_.places()) {
    const Eigen::Vector3d at = place.T_map_lidar.translation();
    const std::int32_t x0 = upright_cell_of(at.x()), y0 = upright_cell_of(at.y());
    for (std::int32_t y = y0 - reach; y <= y0 + reach; ++y) {
      for (std::int32_t x = x0 - reach; x <= x0 + reach; ++x) {
        if (x % kStride != 0 || y % kStride != 0 || std::hypot(x - x0, y - y0) > reach) continue;
        if (taken.insert({y, x}).second) ground_.push_back({x, y, at.z()});
      }
    }
  }
}

std::vector<PlaceSearch::Sought> PlaceSearch::sought(const SurfacePatches& patches, int yaw) const {
  const Eigen::Matrix3d R = turned(yaw);
  std::vector<Sought> all;
  for (const SurfacePatch& patch : patches) {
    SurfacePatch seen = patch;
    seen.mean = R * patch.mean, seen.normal = R * patch.normal;
    all.push_back({upright_cell_of(seen.mean.x()), upright_cell_of(seen.mean.y()), facings_of(seen)});
  }
  return all;
}

int PlaceSearch::score(const std::vector<Sought>& sought, std::int32_t x, std::int32_t y) const {
  int score = 0;
  for (const Sought& s : sought) {
    if (!holds(x + s.dx, y + s.dy)) continue;
    const std::size_t i = index(x + s.dx, y + s.dy);
    score += ((near_[i] & s.facings) != 0) + ((exact_[i] & s.facings) != 0);
  }
  return score;
}

void PlaceSearch::coarse_at(const std::vector<Sought>& sought, int yaw, std::vector<Peak>& peaks) const {
  const auto enough = int(kPromising * double(sought.size()));
  const std::size_t all = sought.size();
  for (const Ground& g : ground_) {
    int found = 0;
    for (std::size_t i = 0; i < all; ++i) {
      const Sought& s = sought[i];
      if (holds(g.x + s.dx, g.y + s.dy)) found += (near_[index(g.x + s.dx, g.y + s.dy)] & s.facings) != 0;
      if (found + int(all - i) < enough) break;
    }
    if (found >= enough) peaks.push_back({g.x, g.y, yaw, found});
  }
}

std::vector<PlaceSearch::Peak> PlaceSearch::coarse(const SurfacePatches& patches) const {
  std::vector<std::vector<Peak>> by_yaw(kYaws / kCoarseYaws);
  parallel_for(by_yaw.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      coarse_at(sought(patches, int(i) * kCoarseYaws), int(i) * kCoarseYaws, by_yaw[i]);
  });
  std::vector<Peak> peaks;
  for (const std::vector<Peak>& some : by_yaw) peaks.insert(peaks.end(), some.begin(), some.end());
  return best_of(std::move(peaks), std::size_t(options_.coarse_candidates), kStride / 2, kCoarseYaws / 2);
}

PlaceSearch::Peak PlaceSearch::refined(const Peak& start, const std::vector<std::vector<Sought>>& by_yaw) const {
  constexpr int kSide = 2 * kStride + 1;  // [cells] about the start
  Peak best = start;
  best.score = 0;
  for (int turn = -kCoarseYaws; turn <= kCoarseYaws; ++turn) {
    const int yaw = (start.yaw + turn + kYaws) % kYaws;
    for (int cell = 0; cell < kSide * kSide; ++cell) {
      const std::int32_t x = start.x + cell % kSide - kStride, y = start.y + cell / kSide - kStride;
      const int found = score(by_yaw[std::size_t(yaw)], x, y);
      if (found > best.score) best = {x, y, yaw, found};
    }
  }
  return best;
}

std::vector<PlaceCandidate> PlaceSearch::find(const SurfacePatches& patches) const {
  const SurfacePatches some = compared(patches, options_);
  if (some.empty() || exact_.empty()) return {};
  std::vector<std::vector<Sought>> by_yaw;
  for (int yaw = 0; yaw < kYaws; ++yaw) by_yaw.push_back(sought(some, yaw));
  std::vector<Peak> peaks;
  for (const Peak& p : coarse(some)) peaks.push_back(refined(p, by_yaw));
  std::vector<PlaceCandidate> candidates;
  for (const Peak& p : best_of(std::move(peaks), std::size_t(options_.max_candidates), 2, 3)) {
    const Eigen::Vector2d at = kUprightCell * Eigen::Vector2d(p.x, p.y);
    const auto apart = [&](const Ground& g) { return std::hypot(g.x - p.x, g.y - p.y); };
    const auto ground = std::min_element(ground_.begin(), ground_.end(),
                                         [&](const Ground& a, const Ground& b) { return apart(a) < apart(b); });
    candidates.push_back({Pose(Eigen::Translation3d(at.x(), at.y(), ground->z) * Eigen::Quaterniond(turned(p.yaw))),
                          double(p.score) / (2.0 * double(some.size()))});
  }
  return candidates;
}

}  // namespace tilth

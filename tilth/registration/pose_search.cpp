#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>

#include <tilth/core/evenly_chosen.hpp>
#include <tilth/registration/pose_search.hpp>

namespace tilth {
namespace {

constexpr int kFacings = 8;
constexpr double kMostUpward = 0.7;  // z of the normal of what stands upright, at most
constexpr std::uint8_t kHit = 2, kBeside = 1;

bool is_upright(const FacingPoint& p) {
  return std::abs(p.normal.z()) < kMostUpward;
}

int facing_of(const Eigen::Vector3d& normal) {
  const double turns = std::atan2(normal.y(), normal.x()) / (2 * std::numbers::pi);
  return (int(std::floor(turns * kFacings + 0.5)) + kFacings) % kFacings;
}

/// What stands around the start, seen from above.
class FacingGrid {
 public:
  FacingGrid(double cell, int half) : cell_(cell), half_(half), side_(2 * half + 1) {
    for (std::vector<std::uint8_t>& layer : layers_) layer.assign(std::size_t(side_) * std::size_t(side_), 0);
  }

  int cell_of(double x) const { return int(std::lround(x / cell_)); }
  bool holds(int x, int y, int margin) const { return std::max(std::abs(x), std::abs(y)) <= half_ - margin; }
  const std::uint8_t* row(int facing, int x, int y) const { return &layers_[std::size_t(facing)][index(x, y)]; }

  void add(const FacingPoint& p) {
    const int x = cell_of(p.point.x()), y = cell_of(p.point.y()), facing = facing_of(p.normal);
    if (!holds(x, y, 1)) return;
    for (int turn = -1; turn <= 1; ++turn) add_around(x, y, (facing + turn + kFacings) % kFacings);
    layers_[std::size_t(facing)][index(x, y)] = kHit;
  }

 private:
  std::size_t index(int x, int y) const { return std::size_t(y + half_) * std::size_t(side_) + std::size_t(x + half_); }

  void add_around(int x, int y, int facing) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        std::uint8_t& value = layers_[std::size_t(facing)][index(x + dx, y + dy)];
        value = std::max(value, kBeside);
      }
    }
  }

  double cell_;
  int half_, side_;
  std::array<std::vector<std::uint8_t>, kFacings> layers_;
};

struct Cell {
  int x = 0, y = 0, yaw = 0;
  std::uint16_t score = 0;
};

/// One upright point a cell and facing, at most so many, evenly.
std::vector<FacingPoint> thinned(std::span<const FacingPoint> source, const PoseSearchOptions& options) {
  std::set<std::array<int, 3>> seen;
  std::vector<FacingPoint> kept;
  for (const FacingPoint& p : source) {
    if (!is_upright(p) || p.point.head<2>().norm() > options.range) continue;
    const Eigen::Vector2d at = p.point.head<2>() / options.cell;
    if (seen.insert({int(std::lround(at.x())), int(std::lround(at.y())), facing_of(p.normal)}).second)
      kept.push_back(p);
  }
  return evenly_chosen<FacingPoint>(kept, std::size_t(options.max_points));
}

/// Scores of all shifts at one yaw, a row for each y.
class ShiftScores {
 public:
  explicit ShiftScores(int half) : half_(half), side_(2 * half + 1) {}

  void count(const FacingGrid& grid, const std::vector<FacingPoint>& source, double yaw) {
    scores_.assign(std::size_t(side_) * std::size_t(side_), 0);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (const FacingPoint& p : source) {
      const Eigen::Vector3d at = R * p.point;
      const int x = grid.cell_of(at.x()), y = grid.cell_of(at.y());
      if (grid.holds(x, y, half_)) add(grid, x, y, facing_of(R * p.normal));
    }
  }

  /// Adds the shifts that no neighbour beats.
  void peaks(int yaw, std::vector<Cell>& cells) const {
    for (int y = -half_; y <= half_; ++y) {
      for (int x = -half_; x <= half_; ++x) {
        if (at(x, y) > 0 && is_peak(x, y)) cells.push_back({x, y, yaw, at(x, y)});
      }
    }
  }

 private:
  std::uint16_t at(int x, int y) const {
    return scores_[std::size_t(y + half_) * std::size_t(side_) + std::size_t(x + half_)];
  }

  void add(const FacingGrid& grid, int x, int y, int facing) {
    for (int dy = -half_; dy <= half_; ++dy) {
      const std::uint8_t* from = grid.row(facing, x - half_, y + dy);
      std::uint16_t* to = &scores_[std::size_t(dy + half_) * std::size_t(side_)];
      for (int i = 0; i < side_; ++i) to[i] = std::uint16_t(to[i] + from[i]);
    }
  }

  bool is_peak(int x, int y) const {
    for (int j = std::max(y - 1, -half_); j <= std::min(y + 1, half_); ++j) {
      for (int i = std::max(x - 1, -half_); i <= std::min(x + 1, half_); ++i) {
        if (at(i, j) > at(x, y)) return false;
      }
    }
    return true;
  }

  int half_, side_;
  std::vector<std::uint16_t> scores_;
};

/// Best first; of equal ones, the nearest to the start. Those beside a better one go.
std::vector<Cell> best_of(std::vector<Cell> cells, std::size_t most) {
  const auto far = [](const Cell& c) { return c.x * c.x + c.y * c.y + c.yaw * c.yaw; };
  std::stable_sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
    return a.score != b.score ? a.score > b.score : far(a) < far(b);
  });
  std::vector<Cell> best;
  for (const Cell& c : cells) {
    const auto beside = [&](const Cell& b) {
      return std::abs(b.x - c.x) <= 1 && std::abs(b.y - c.y) <= 1 && std::abs(b.yaw - c.yaw) <= 2;
    };
    if (std::none_of(best.begin(), best.end(), beside)) best.push_back(c);
    if (best.size() == most) break;
  }
  return best;
}

}  // namespace

std::vector<PoseCandidate> search_poses(std::span<const FacingPoint> target, std::span<const FacingPoint> source,
                                        const Pose& T_start, const SearchWindow& window,
                                        const PoseSearchOptions& options) {
  const std::vector<FacingPoint> points = thinned(source, options);
  if (points.empty()) return {};
  const int shifts = int(std::ceil(window.radius / options.cell)), yaws = int(std::ceil(window.yaw / options.yaw_step));
  FacingGrid grid(options.cell, int(std::ceil(options.range / options.cell)) + shifts + 1);
  const Pose T_start_target = T_start.inverse();
  for (const FacingPoint& p : target) {
    const FacingPoint seen{T_start_target * p.point, T_start_target.linear() * p.normal};
    if (is_upright(seen)) grid.add(seen);
  }
  std::vector<Cell> cells;
  ShiftScores scores(shifts);
  for (int yaw = -yaws; yaw <= yaws; ++yaw) {
    scores.count(grid, points, yaw * options.yaw_step);
    scores.peaks(yaw, cells);
  }
  std::vector<PoseCandidate> candidates;
  for (const Cell& c : best_of(std::move(cells), std::size_t(options.max_candidates))) {
    const Pose motion = Eigen::Translation3d(c.x * options.cell, c.y * options.cell, 0) *
                        Eigen::AngleAxisd(c.yaw * options.yaw_step, Eigen::Vector3d::UnitZ());
    candidates.push_back({T_start * motion, double(c.score) / (kHit * double(points.size()))});
  }
  return candidates;
}

}  // namespace tilth

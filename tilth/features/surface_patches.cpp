#include <algorithm>
#include <array>
#include <cmath>

#include <tilth/core/least_spread.hpp>
#include <tilth/features/surface_patches.hpp>

namespace tilth {
namespace {

using Rings = std::vector<std::vector<RingSegment>>;

// A run between those beside it: two rings down, one down, itself, one up, two up; nullptr where there is none.
using Column = std::array<const RingSegment*, 5>;
constexpr std::size_t kSelf = 2, kBelow = 1, kAbove = 3;

// The run of `ring` nearest in azimuth, for azimuths that ascend from call to call.
const RingSegment* nearest(const std::vector<RingSegment>& ring, float azimuth, std::size_t& cursor) {
  if (ring.empty()) return nullptr;
  const auto distance = [&](std::size_t i) { return std::abs(ring[i].azimuth - azimuth); };
  while (cursor + 1 < ring.size() && distance(cursor + 1) <= distance(cursor)) ++cursor;
  return &ring[cursor];
}

class ColumnWalk {
 public:
  ColumnWalk(const Rings& rings, std::size_t ring) : rings_(rings), ring_(ring) {}

  Column at(const RingSegment& segment) {
    constexpr float kBeside = 0.03f;  // [rad]
    Column column{};
    column[kSelf] = &segment;
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (i == kSelf || ring_ + i < kSelf || ring_ + i - kSelf >= rings_.size()) continue;
      const RingSegment* other = nearest(rings_[ring_ + i - kSelf], segment.azimuth, cursors_[i]);
      if (other && std::abs(other->azimuth - segment.azimuth) < kBeside + segment.width) column[i] = other;
    }
    return column;
  }

 private:
  const Rings& rings_;
  std::size_t ring_;
  std::array<std::size_t, 5> cursors_{};
};

struct Moments {
  double count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();

  void add(const RingSegment& s) {
    const double total = count + s.count;
    const Eigen::Vector3d d = s.mean - mean;
    scatter += s.scatter + (count * s.count / total) * d * d.transpose();
    mean += d * (s.count / total);
    count = total;
  }
  Eigen::Matrix3d covariance() const { return scatter / std::max(1.0, count - 1); }
};

// Looks for the flattest plane through a run and runs beside it.
class PatchFitter {
 public:
  explicit PatchFitter(const PatchOptions& options) : options_(options) {}

  bool fit(const Column& column, SurfacePatch& patch) {
    const RingSegment& self = *column[kSelf];
    const double range = self.mean.norm();
    const bool pole = self.free && self.width * range < options_.pole_width;
    if (!pole && fit_plane(column, range)) {
      patch = shaped(self, true);
      return true;
    }
    Moments moments;
    moments.add(self);
    const double reach = std::max(0.4, 0.05 * range);
    for (const std::size_t i : {kBelow, kAbove}) {
      if (column[i] && (column[i]->mean - self.mean).norm() < reach) moments.add(*column[i]);
    }
    if (moments.count == self.count) return false;
    covariance_ = moments.covariance();
    patch = shaped(self, false);
    return true;
  }

 private:
  static double square(double x) { return x * x; }

  bool fit_plane(const Column& column, double range) {
    constexpr double kFlatAtOnce = 0.5;  // of the greatest thickness: no other beams need be asked
    flattest_ = square(options_.max_thickness);
    bool found = false;
    for (const std::array<std::size_t, 3>& three : {std::array<std::size_t, 3>{1, 2, 3}, {0, 1, 2}, {2, 3, 4}}) {
      if (column[three[0]] && column[three[1]] && column[three[2]])
        found |= is_flatter({column[three[0]], column[three[1]], column[three[2]]});
      if (found && flattest_ < square(kFlatAtOnce * options_.max_thickness)) return true;
    }
    if (found) return true;
    const double reach = std::max(options_.max_gap, options_.max_gap_share * range);
    for (const std::size_t i : {kBelow, kAbove}) {
      if (column[i] && (column[i]->mean - column[kSelf]->mean).norm() < reach)
        found |= is_flatter({column[kSelf], column[i]});
    }
    return found;
  }

  bool is_flatter(std::initializer_list<const RingSegment*> segments) {
    constexpr double kFlat = 9, kLeastWidth = 4e-4;  // of variances; [m^2]
    Moments moments;
    for (const RingSegment* segment : segments) moments.add(*segment);
    const Eigen::Matrix3d covariance = moments.covariance();
    const Eigen::Vector3d variances = spreads(covariance);
    if (variances[0] > flattest_ || variances[1] < std::max(kFlat * variances[0], kLeastWidth)) return false;
    flattest_ = variances[0];
    covariance_ = covariance;
    return true;
  }

  // The patch of the run and of covariance_.
  SurfacePatch shaped(const RingSegment& self, bool flat) {
    const double least = flat ? flattest_ : spreads(covariance_)[0];
    const Eigen::Vector3d normal = direction_of_least(covariance_, least);
    return {.mean = self.mean,
            .covariance = covariance_,
            .normal = normal.dot(self.mean) > 0 ? Eigen::Vector3d(-normal) : normal,
            .time = self.time,
            .thickness = float(std::max(0.0, least)),
            .flat = flat};
  }

  const PatchOptions& options_;
  Eigen::Matrix3d covariance_;
  double flattest_ = 0;
};

}  // namespace

SurfacePatches surface_patches(const PointCloud& cloud, const RingLayout& layout, std::span<const std::uint8_t> keep,
                               const PatchOptions& options) {
  const Rings rings = ring_segments(cloud, layout, keep, options.segments);
  SurfacePatches patches;
  PatchFitter fitter(options);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    ColumnWalk walk(rings, r);
    SurfacePatch patch;
    for (const RingSegment& segment : rings[r]) {
      if (!fitter.fit(walk.at(segment), patch)) continue;
      patch.ring = std::uint16_t(r);
      patches.push_back(patch);
    }
  }
  return patches;
}

SurfacePatches surface_patches(const PointCloud& cloud, const PatchOptions& options) {
  RingLayout rings;
  arrange(cloud, rings);  // rings that overlap in elevation are rings all the same
  return surface_patches(cloud, rings, std::vector<std::uint8_t>(cloud.size(), 1), options);
}

}  // namespace tilth

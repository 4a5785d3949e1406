#include <algorithm>
#include <array>
#include <cmath>

#include <tilth/core/least_spread.hpp>
#include <tilth/features/surface_patches.hpp>

namespace tilth {
namespace {

// A run between those beside it: two rings down, one down, itself, one up, two up; nullptr where there is none.
using Column = std::array<const RingSegment*, 5>;
constexpr std::size_t kSelf = 2, kBelow = 1, kAbove = 3;

// The run of `ring` nearest in azimuth, for azimuths that ascend from call to call.
const RingSegment* nearest(std::span<const RingSegment> ring, float azimuth, std::size_t& cursor) {
  if (ring.empty()) return nullptr;
  const auto distance = [&](std::size_t i) { return std::abs(ring[i].azimuth - azimuth); };
  while (cursor + 1 < ring.size() && distance(cursor + 1) <= distance(cursor)) ++cursor;
  return &ring[cursor];
}

class ColumnWalk {
 public:
  ColumnWalk(const RingSegments& rings, std::size_t ring) : rings_(rings), ring_(ring) {}

  Column at(const RingSegment& segment) {
    constexpr float kBeside = 0.03f;  // [rad]
    Column column{};
    column[kSelf] = &segment;
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (i == kSelf || ring_ + i < kSelf || ring_ + i - kSelf >= rings_.rings()) continue;
      const RingSegment* other = nearest(rings_.ring(ring_ + i - kSelf), segment.azimuth, cursors_[i]);
      if (other && std::abs(other->azimuth - segment.azimuth) < kBeside + segment.width) column[i] = other;
    }
    return column;
  }

 private:
  const RingSegments& rings_;
  std::size_t ring_;
  std::array<std::size_t, 5> cursors_{};
};

// Looks for the flattest plane through a run and runs beside it.
class PatchFitter {
 public:
  explicit PatchFitter(const PatchOptions& options) : options_(options) {}

  bool fit(const Column& column, SurfacePatch& patch) {
    const RingSegment& self = *column[kSelf];
    const double range = self.moments.mean.norm();
    const bool pole = self.free && self.width * range < options_.pole_width;
    if (!pole && fit_plane(column, range)) {
      patch = shaped(self, true);
      return true;
    }
    Moments moments = self.moments;
    const double reach = std::max(0.4, 0.05 * range);
    for (const std::size_t i : {kBelow, kAbove}) {
      if (column[i] && (column[i]->moments.mean - self.moments.mean).norm() < reach) moments.add(column[i]->moments);
    }
    if (moments.count == self.moments.count) return false;
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
        found |= is_flatter(column[three[0]], column[three[1]], column[three[2]]);
      if (found && flattest_ < square(kFlatAtOnce * options_.max_thickness)) return true;
    }
    if (found) return true;
    const double reach = std::max(options_.max_gap, options_.max_gap_share * range);
    for (const std::size_t i : {kBelow, kAbove}) {
      if (column[i] && (column[i]->moments.mean - column[kSelf]->moments.mean).norm() < reach)
        found |= is_flatter(column[kSelf], column[i]);
    }
    return found;
  }

  template <class... Others>
  bool is_flatter(const RingSegment* first, const Others*... others) {
    constexpr double kFlat = 9, kLeastWidth = 4e-4;  // of variances; [m^2]
    Moments moments = first->moments;
    (moments.add(others->moments), ...);
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
    return {.mean = self.moments.mean,
            .covariance = covariance_,
            .normal = normal.dot(self.moments.mean) > 0 ? Eigen::Vector3d(-normal) : normal,
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
  const RingSegments rings = ring_segments(cloud, layout, keep, options.segments);
  SurfacePatches patches;
  patches.reserve(rings.segments.size());
  PatchFitter fitter(options);
  for (std::size_t r = 0; r < rings.rings(); ++r) {
    ColumnWalk walk(rings, r);
    SurfacePatch patch;
    for (const RingSegment& segment : rings.ring(r)) {
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

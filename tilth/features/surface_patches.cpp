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

// A plane that may lie through a run and runs beside it.
struct Candidate {
  Moments moments;
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();  // [m^2] ascending
};

// Looks for the flattest plane through a run and runs beside it.
class PatchFitter {
 public:
  explicit PatchFitter(const PatchOptions& options) : options_(options) {}

  // A pole, which is no plane whatever lies beside it.
  bool is_pole(const RingSegment& self) const {
    return self.free && self.width * self.moments.mean.norm() < options_.pole_width;
  }

  // `first` is the plane with the runs just below and above; nullptr where one is missing.
  bool fit(const Column& column, const Candidate* first, SurfacePatch& patch) {
    const RingSegment& self = *column[kSelf];
    const double range = self.moments.mean.norm();
    if (!is_pole(self) && fit_plane(column, first, range)) {
      patch = shaped(self, flattest_, true);
      return true;
    }
    Moments moments = self.moments;
    const double reach = std::max(0.4, 0.05 * range);
    for (const std::size_t i : {kBelow, kAbove}) {
      if (column[i] && (column[i]->moments.mean - self.moments.mean).norm() < reach) moments.add(column[i]->moments);
    }
    if (moments.count == self.moments.count) return false;
    flattest_moments_ = moments;
    patch = shaped(self, spreads(moments.covariance())[0], false);
    return true;
  }

 private:
  static double square(double x) { return x * x; }

  bool fit_plane(const Column& column, const Candidate* first, double range) {
    constexpr double kFlatAtOnce = 0.5;  // of the greatest thickness: no other beams need be asked
    flattest_ = square(options_.max_thickness);
    bool found = first != nullptr && is_flatter(*first);
    const auto flat_enough = [&] { return found && flattest_ < square(kFlatAtOnce * options_.max_thickness); };
    for (const std::size_t i : {std::size_t{0}, kSelf}) {
      if (flat_enough()) return true;
      if (column[i] && column[i + 1] && column[i + 2]) found |= is_flatter(column[i], column[i + 1], column[i + 2]);
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
    Candidate candidate{.moments = first->moments};
    (candidate.moments.add(others->moments), ...);
    candidate.variances = spreads(candidate.moments.covariance());
    return is_flatter(candidate);
  }

  bool is_flatter(const Candidate& candidate) {
    constexpr double kFlat = 9, kLeastWidth = 4e-4;  // of variances; [m^2]
    const Eigen::Vector3d& variances = candidate.variances;
    if (variances[0] > flattest_ || variances[1] < std::max(kFlat * variances[0], kLeastWidth)) return false;
    flattest_ = variances[0];
    flattest_moments_ = candidate.moments;
    return true;
  }

  // The patch of the run, shaped as flattest_moments_ are, whose least variance is given.
  SurfacePatch shaped(const RingSegment& self, double least, bool flat) const {
    const Eigen::Matrix3d covariance = flattest_moments_.covariance();
    const Eigen::Vector3d normal = direction_of_least(covariance, least);
    return {.mean = self.moments.mean,
            .covariance = covariance,
            .normal = normal.dot(self.moments.mean) > 0 ? Eigen::Vector3d(-normal) : normal,
            .time = self.time,
            .thickness = float(std::max(0.0, least)),
            .flat = flat};
  }

  const PatchOptions& options_;
  Moments flattest_moments_;
  double flattest_ = 0;  // [m^2]
};

// The runs of one ring, what lies beside them, and the first plane to be tried for each, all at once.
struct RingColumns {
  std::vector<Column> columns;
  std::vector<Candidate> first;
  std::vector<std::uint8_t> has_first;
  std::vector<Vector6d> covariances;
  std::vector<Eigen::Vector3d> variances;

  void fill(const RingSegments& rings, std::size_t ring, const PatchFitter& fitter) {
    ColumnWalk walk(rings, ring);
    columns.clear();
    first.clear();
    has_first.clear();
    covariances.clear();
    for (const RingSegment& segment : rings.ring(ring)) {
      const Column& column = columns.emplace_back(walk.at(segment));
      has_first.push_back(column[kBelow] != nullptr && column[kAbove] != nullptr && !fitter.is_pole(segment));
      Moments moments;
      if (has_first.back()) {
        moments = column[kBelow]->moments;
        moments.add(segment.moments);
        moments.add(column[kAbove]->moments);
      }
      first.push_back({.moments = moments});
      covariances.push_back(moments.covariance_entries());
    }
    variances.resize(covariances.size());
    spreads(covariances, variances);
    for (std::size_t i = 0; i < first.size(); ++i) first[i].variances = variances[i];
  }
};

}  // namespace

SurfacePatches surface_patches(const PointCloud& cloud, const RingLayout& layout, std::span<const std::uint8_t> keep,
                               const PatchOptions& options) {
  const RingSegments rings = ring_segments(cloud, layout, keep, options.segments);
  SurfacePatches patches;
  patches.reserve(rings.segments.size());
  PatchFitter fitter(options);
  RingColumns ring;
  for (std::size_t r = 0; r < rings.rings(); ++r) {
    ring.fill(rings, r, fitter);
    SurfacePatch patch;
    for (std::size_t i = 0; i < ring.columns.size(); ++i) {
      if (!fitter.fit(ring.columns[i], ring.has_first[i] ? &ring.first[i] : nullptr, patch)) continue;
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

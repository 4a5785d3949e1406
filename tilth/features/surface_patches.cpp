#include <algorithm>
#include <cmath>

#include <tilth/core/symmetric_eigen.hpp>
#include <tilth/features/joined_shapes.hpp>
#include <tilth/features/neighborhood_patches.hpp>
#include <tilth/features/plane_misfit.hpp>
#include <tilth/features/run_columns.hpp>
#include <tilth/features/surface_patches.hpp>

namespace tilth {
namespace {

double square(double x) {
  return x * x;
}

bool is_within(double reach, const RingSegment* a, const RingSegment& b) {
  return a != nullptr && (a->moments.mean - b.moments.mean).norm() < reach;
}

// Looks for the flattest plane through each run of a ring and runs beside it, for all runs at once.
class RingFitter {
 public:
  RingFitter(const RingSegments& rings, const PatchOptions& options)
      : rings_(rings), azimuths_(azimuths_of(rings)), options_(options) {}

  void fit(std::size_t ring, SurfacePatches& patches) {
    begin(ring);
    offer_three(1);
    offer_three(0);
    offer_three(2);
    offer_pairs();
    shape_the_rest();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (fits_[i].shaped) patches.push_back(patch_of(i, ring));
    }
  }

 private:
  // What is known of a run.
  struct Fit {
    double range;  // [m]
    bool is_pole;  // which is no plane whatever lies beside it
    bool flat = false, shaped = false;
    double least = 0;  // [m^2] variance of the flattest plane; the greatest there may be as long as there is none
    Symmetric3d covariance = {};  // [m^2] of its points
  };

  void begin(std::size_t ring) {
    ColumnWalk walk(rings_, azimuths_, ring);
    columns_.clear();
    fits_.clear();
    for (const RingSegment& segment : rings_.ring(ring)) {
      columns_.push_back(walk.at(segment));
      const double range = segment.moments.mean.norm();
      fits_.push_back({.range = range,
                       .is_pole = segment.free && segment.width * range < options_.pole_width,
                       .least = square(options_.max_thickness)});
    }
  }

  void ask(std::size_t run, const RingSegment* a, const RingSegment* b, const RingSegment* c) {
    const auto moments = [](const RingSegment* s) { return s != nullptr ? &s->moments : nullptr; };
    runs_.push_back(std::uint32_t(run));
    sets_.push_back({moments(a), moments(b), moments(c)});
  }

  // Calls visit(fit, set, shape) for all that was asked.
  template <class Visit>
  void answer(const Visit& visit) {
    shapes_.resize(sets_.size());
    join_runs(sets_, shapes_);
    for (std::size_t i = 0; i < sets_.size(); ++i) visit(fits_[runs_[i]], sets_[i], shapes_[i]);
    sets_.clear();
    runs_.clear();
  }

  // Two lines are always in one plane.
  bool one_plane(const RunSet& set, const PlaneShape& shape) const {
    if (set[2] == nullptr) return true;
    const Eigen::Vector3d normal = smallest_eigenvector(shape.covariance, shape.variances[0]);
    return is_one_plane(plane_misfit(set, normal), options_.max_misfit, options_.roughness);
  }

  void take_flatter_planes() {
    answer([this](Fit& fit, const RunSet& set, const PlaneShape& shape) {
      constexpr double kLeastWidth = 4e-4;  // [m^2]
      if (!is_flat(shape.variances, fit.least) || shape.variances[1] < kLeastWidth) return;
      if (one_plane(set, shape)) take(fit, shape);
    });
  }

  static void take(Fit& fit, const PlaneShape& shape) {
    fit.least = shape.variances[0];
    fit.covariance = shape.covariance;
    fit.flat = fit.shaped = true;
  }

  // Three runs above one another, from `lowest` of the column on, for runs that are not flat enough as yet.
  void offer_three(std::size_t lowest) {
    constexpr double kFlatAtOnce = 0.5;  // of the greatest thickness: no other beams need be asked
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Fit& fit = fits_[i];
      if (fit.is_pole || (fit.flat && fit.least < square(kFlatAtOnce * options_.max_thickness))) continue;
      const Column& c = columns_[i];
      if (c[lowest] && c[lowest + 1] && c[lowest + 2]) ask(i, c[lowest], c[lowest + 1], c[lowest + 2]);
    }
    take_flatter_planes();
  }

  // A run and the one below or above, where no three lie in a plane.
  void offer_pairs() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (fits_[i].is_pole || fits_[i].flat) continue;
      const Column& c = columns_[i];
      const double reach = std::max(options_.max_gap, options_.max_gap_ratio * fits_[i].range);
      for (const std::size_t other : {kBelow, kAbove}) {
        if (is_within(reach, c[other], *c[kSelf])) ask(i, c[kSelf], c[other], nullptr);
      }
    }
    take_flatter_planes();
  }

  // What is no plane has the shape of the run and those near it.
  void shape_the_rest() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (fits_[i].flat) continue;
      const Column& c = columns_[i];
      const double reach = std::max(0.4, 0.05 * fits_[i].range);
      const bool below = is_within(reach, c[kBelow], *c[kSelf]), above = is_within(reach, c[kAbove], *c[kSelf]);
      if (below || above) ask(i, c[kSelf], below ? c[kBelow] : nullptr, above ? c[kAbove] : nullptr);
    }
    answer([](Fit& fit, const RunSet&, const PlaneShape& shape) {
      fit.least = shape.variances[0];
      fit.covariance = shape.covariance;
      fit.shaped = true;
    });
  }

  // Normal and thickness are eigenvector and eigenvalue, the smallest, of the covariance (docs/method.md, 1).
  SurfacePatch patch_of(std::size_t run, std::size_t ring) const {
    const RingSegment& self = *columns_[run][kSelf];
    const Fit& fit = fits_[run];
    const Eigen::Vector3d normal = smallest_eigenvector(fit.covariance, fit.least);
    return {.mean = self.moments.mean,
            .covariance = fit.covariance.matrix(),
            .normal = normal.dot(self.moments.mean) > 0 ? Eigen::Vector3d(-normal) : normal,
            .time = self.time,
            .thickness = float(std::max(0.0, fit.least)),
            .points = std::uint16_t(self.moments.count),
            .ring = std::uint16_t(ring),
            .flat = fit.flat};
  }

  const RingSegments& rings_;
  std::vector<float> azimuths_;  // [rad] of all runs
  const PatchOptions& options_;
  std::vector<Column> columns_;  // a run each
  std::vector<Fit> fits_;
  std::vector<std::uint32_t> runs_;  // of the sets that are asked for
  std::vector<RunSet> sets_;
  std::vector<PlaneShape> shapes_;
};

}  // namespace

SurfacePatches surface_patches(const PointCloud& cloud, const RingLayout& layout, std::span<const std::uint8_t> keep,
                               const PatchOptions& options) {
  if (!cloud.has_rings()) return neighborhood_patches(cloud, keep, options);
  const RingSegments rings = ring_segments(cloud, layout, keep, options.segments);
  SurfacePatches patches;
  patches.reserve(rings.segments.size());
  RingFitter fitter(rings, options);
  for (std::size_t r = 0; r < rings.rings(); ++r) fitter.fit(r, patches);
  return patches;
}

SurfacePatches surface_patches(const PointCloud& cloud, const PatchOptions& options) {
  RingLayout rings;
  arrange(cloud, rings);  // rings that overlap in elevation are rings all the same
  return surface_patches(cloud, rings, std::vector<std::uint8_t>(cloud.size(), 1), options);
}

}  // namespace tilth

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/features/ring_segments.hpp>

namespace tilth {
namespace {

struct Sighting {
  float azimuth;  // [rad]
  std::uint32_t index;
};
using RingOrder = std::vector<Sighting>;

constexpr float kMostSteps = 4.0f;  // columns without a return that still are one run

bool before(const Sighting& a, const Sighting& b) {
  return a.azimuth < b.azimuth;
}

// atan2 to 1e-5 rad, in a few operations (Abramowitz and Stegun 4.4.49).
float azimuth_of(const Eigen::Vector3d& p) {
  const float x = float(p.x()), y = float(p.y()), a = std::abs(x), b = std::abs(y);
  const float t = std::min(a, b) / std::max(std::max(a, b), 1e-20f), s = t * t;
  float angle = t * (0.9998660f + s * (-0.3302995f + s * (0.1801410f + s * (-0.0851330f + s * 0.0208351f))));
  if (b > a) angle = std::numbers::pi_v<float> / 2 - angle;
  if (x < 0) angle = std::numbers::pi_v<float> - angle;
  return y < 0 ? -angle : angle;
}

// Firing order is ascending or descending azimuth from anywhere on the circle: both are put right without sorting.
void put_in_order(RingOrder& ring) {
  std::size_t ascents = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) ascents += ring[i - 1].azimuth < ring[i].azimuth;
  if (2 * ascents < ring.size()) std::reverse(ring.begin(), ring.end());
  std::rotate(ring.begin(), std::is_sorted_until(ring.begin(), ring.end(), before), ring.end());
  if (!std::is_sorted(ring.begin(), ring.end(), before)) std::stable_sort(ring.begin(), ring.end(), before);
}

std::vector<RingOrder> rings_of(const PointCloud& cloud) {
  if (!cloud.has_rings() || cloud.empty()) return {};
  std::vector<RingOrder> rings(std::size_t(*std::max_element(cloud.rings.begin(), cloud.rings.end())) + 1);
  for (RingOrder& ring : rings) ring.reserve(2 * cloud.size() / rings.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    rings[cloud.rings[i]].push_back({azimuth_of(p), i});
  }
  for (RingOrder& ring : rings) put_in_order(ring);
  return rings;
}

// [rad] between two firings: the median of some of the steps.
float column_step(const RingOrder& ring) {
  std::vector<float> steps;
  const std::size_t stride = std::max<std::size_t>(1, ring.size() / 64);
  for (std::size_t i = stride; i < ring.size(); i += stride) steps.push_back(ring[i].azimuth - ring[i - 1].azimuth);
  if (steps.empty()) return 1e-4f;
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  return std::max(steps[steps.size() / 2], 1e-4f);
}

// Cuts one ring; adds up the moments of a run about its first point.
class RingCutter {
 public:
  RingCutter(const PointCloud& cloud, const SegmentOptions& options) : cloud_(cloud), options_(options) {}

  std::vector<RingSegment> cut(const RingOrder& ring) {
    segments_.clear();
    const double step = column_step(ring);
    bool after_jump = true;
    Sighting last{};
    double last_range = 0;
    for (const Sighting& sighting : ring) {
      const Eigen::Vector3d& p = cloud_.points[sighting.index];
      const double range = p.norm();
      if (count_ > 0) {
        const double gap_squared = (p - cloud_.points[last.index]).squaredNorm();
        const bool jump = std::abs(range - last_range) > std::max(options_.min_jump, options_.jump_share * range) ||
                          gap_squared > square(std::max(options_.min_jump, 12 * range * step)) ||
                          sighting.azimuth - last.azimuth > kMostSteps * step;
        if (jump || (p - first_).squaredNorm() > square(std::max(options_.length, 4.5 * step * range))) {
          close(last.azimuth, after_jump && jump);
          after_jump = jump;
        }
      }
      add(sighting, p);
      last = sighting;
      last_range = range;
    }
    if (count_ > 0) close(last.azimuth, after_jump);
    return segments_;
  }

 private:
  void add(const Sighting& sighting, const Eigen::Vector3d& p) {
    if (count_++ == 0) {
      first_ = p;
      first_azimuth_ = sighting.azimuth;
      sum_.setZero();
      squares_.setZero();
      products_.setZero();
      times_ = 0;
    }
    const Eigen::Vector3d d = p - first_;
    sum_ += d;
    squares_ += d.cwiseAbs2();
    products_ += Eigen::Vector3d(d.x() * d.y(), d.y() * d.z(), d.z() * d.x());
    if (cloud_.has_times()) times_ += cloud_.times[sighting.index];
  }

  void close(float last_azimuth, bool free) {
    const double n = count_;
    if (count_ >= options_.min_points) {
      const Eigen::Vector3d offset = sum_ / n;
      segments_.push_back({.mean = first_ + offset,
                           .scatter = second_moments() - n * offset * offset.transpose(),
                           .azimuth = 0.5f * (first_azimuth_ + last_azimuth),
                           .width = last_azimuth - first_azimuth_,
                           .time = float(times_ / n),
                           .count = count_,
                           .free = free});
    }
    count_ = 0;
  }

  static double square(double x) { return x * x; }

  Eigen::Matrix3d second_moments() const {
    Eigen::Matrix3d moments = squares_.asDiagonal();
    moments(0, 1) = moments(1, 0) = products_[0];
    moments(1, 2) = moments(2, 1) = products_[1];
    moments(2, 0) = moments(0, 2) = products_[2];
    return moments;
  }

  const PointCloud& cloud_;
  const SegmentOptions& options_;
  std::vector<RingSegment> segments_;
  Eigen::Vector3d first_, sum_, squares_, products_;
  double times_ = 0;
  float first_azimuth_ = 0;
  int count_ = 0;
};

}  // namespace

std::vector<std::vector<RingSegment>> ring_segments(const PointCloud& cloud, const SegmentOptions& options) {
  std::vector<std::vector<RingSegment>> segments;
  RingCutter cutter(cloud, options);
  for (const RingOrder& ring : rings_of(cloud)) segments.push_back(cutter.cut(ring));
  return segments;
}

}  // namespace tilth

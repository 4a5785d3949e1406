#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/sensor/firing_order.hpp>

namespace tilth {
namespace {

using std::numbers::pi;
constexpr double kDegree = pi / 180.0;
constexpr double kNearAxis = 0.2;                   ///< [m] nearer to the axis than this an azimuth tells nothing
constexpr double kLargestRotation = 6.5 * 2 * pi;   ///< [rad]
constexpr double kSmallestRotation = 10 * kDegree;  ///< [rad]
constexpr double kGap = 90 * kDegree;               ///< [rad] a larger step is a gap without returns, crossed forwards
constexpr double kOrderTolerance = 1.5 * kDegree;
constexpr double kRowReturn = 20 * kDegree;  ///< [rad] azimuth falls back by more than this where a row begins

double wrapped(double angle) {
  return std::remainder(angle, 2 * pi);
}

std::vector<double> azimuths(std::span<const Eigen::Vector3d> points) {
  std::vector<double> values(points.size());
  double last = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x(), y = points[i].y();
    if (x * x + y * y > kNearAxis * kNearAxis) last = std::atan2(y, x);
    values[i] = last;
  }
  return values;
}

bool turns_clockwise(std::span<const double> azimuth) {
  double sum = 0.0;
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    const double step = wrapped(azimuth[i] - azimuth[i - 1]);
    if (std::abs(step) < kGap) sum += step;
  }
  return sum < 0.0;
}

/// Azimuth in the direction of the spin, unwrapped.
std::vector<double> unwrapped(std::span<const double> azimuth, double direction) {
  std::vector<double> values(azimuth.size());
  values[0] = direction * azimuth[0];
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    double step = direction * wrapped(azimuth[i] - azimuth[i - 1]);
    if (step < -kGap) step += 2 * pi;
    values[i] = values[i - 1] + step;
  }
  return values;
}

/// Least squares ascending fit by pooling adjacent violators.
std::vector<double> ascending_fit(std::span<const double> values) {
  struct Pool {
    double sum;
    std::size_t count;
    double mean() const { return sum / double(count); }
  };
  std::vector<Pool> pools;
  pools.reserve(values.size());
  for (const double value : values) {
    Pool pool{value, 1};
    while (!pools.empty() && pools.back().mean() >= pool.mean()) {
      pool = {pool.sum + pools.back().sum, pool.count + pools.back().count};
      pools.pop_back();
    }
    pools.push_back(pool);
  }
  std::vector<double> fit;
  fit.reserve(values.size());
  for (const Pool& pool : pools) fit.insert(fit.end(), pool.count, pool.mean());
  return fit;
}

/// Takes each ring's mean distance from the fit out of its values.
void remove_ring_offsets(std::span<const std::uint16_t> rings, std::span<const double> fit,
                         std::vector<double>& values) {
  if (rings.empty()) return;
  std::vector<double> sum(std::size_t(*std::max_element(rings.begin(), rings.end())) + 1, 0.0);
  std::vector<std::size_t> count(sum.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum[rings[i]] += values[i] - fit[i];
    ++count[rings[i]];
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= sum[rings[i]] / double(count[rings[i]]);
}

double mean_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / double(a.size());
}

/// Most points share their azimuth exactly with the one before, and the first column lies at +-180 deg.
bool is_ray_grid(std::span<const double> azimuth, bool clockwise) {
  constexpr double same = 1e-5;
  if (clockwise || std::abs(std::abs(azimuth[0]) - pi) > 0.5 * kDegree) return false;
  std::size_t equal = 0;
  for (std::size_t i = 1; i < azimuth.size(); ++i) equal += std::abs(azimuth[i] - azimuth[i - 1]) < same ? 1 : 0;
  return 2 * equal > azimuth.size();
}

std::vector<std::uint32_t> rows_from(std::span<const double> azimuth, double start, double direction) {
  std::vector<std::uint32_t> first{0};
  double last = 0.0;
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    double turned = std::fmod(direction * (azimuth[i] - start), 2 * pi);
    if (turned < 0.0) turned += 2 * pi;
    if (i > 0 && turned < last - kRowReturn) first.push_back(std::uint32_t(i));
    last = turned;
  }
  return first;
}

/// Mean elevations of the rows all rise or all fall.
bool follow_in_elevation(std::span<const Eigen::Vector3d> points, std::span<const std::uint32_t> first) {
  std::vector<double> mean(first.size(), 0.0);
  for (std::size_t row = 0; row < first.size(); ++row) {
    const std::size_t end = row + 1 < first.size() ? first[row + 1] : points.size();
    for (std::size_t i = first[row]; i < end; ++i) mean[row] += std::atan2(points[i].z(), points[i].head<2>().norm());
    mean[row] /= double(end - first[row]);
  }
  return std::is_sorted(mean.begin(), mean.end()) || std::is_sorted(mean.rbegin(), mean.rend());
}

}  // namespace

std::optional<HeadRotation> find_head_rotation(std::span<const Eigen::Vector3d> points,
                                               std::span<const std::uint16_t> rings) {
  if (points.size() < 2) return std::nullopt;
  const std::vector<double> azimuth = azimuths(points);
  HeadRotation rotation;
  rotation.clockwise = turns_clockwise(azimuth);
  const double direction = rotation.clockwise ? -1.0 : 1.0;
  std::vector<double> turned = unwrapped(azimuth, direction);
  const double total = turned.back() - turned.front();
  if (total < kSmallestRotation || total > kLargestRotation) return std::nullopt;

  remove_ring_offsets(rings, ascending_fit(turned), turned);
  rotation.progress = ascending_fit(turned);
  if (mean_distance(turned, rotation.progress) > kOrderTolerance) return std::nullopt;
  const double start = rotation.progress.front();
  rotation.begin = direction * start;
  for (double& angle : rotation.progress) angle -= start;
  rotation.ray_grid = is_ray_grid(azimuth, rotation.clockwise);
  return rotation;
}

std::optional<std::vector<std::uint32_t>> find_rows(std::span<const Eigen::Vector3d> points) {
  if (points.empty()) return std::nullopt;
  const std::vector<double> azimuth = azimuths(points);
  const double direction = turns_clockwise(azimuth) ? -1.0 : 1.0;
  std::optional<std::vector<std::uint32_t>> best;
  for (const double start : {0.0, pi, azimuth[0]}) {
    std::vector<std::uint32_t> first = rows_from(azimuth, start, direction);
    if (!best || first.size() < best->size()) best = std::move(first);
  }
  if (best->size() < 8 || best->size() > 128 || !follow_in_elevation(points, *best)) return std::nullopt;
  return best;
}

}  // namespace tilth

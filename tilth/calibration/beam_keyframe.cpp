#include <algorithm>
#include <cmath>

#include <tilth/calibration/beam_keyframe.hpp>
#include <tilth/core/evenly_chosen.hpp>

namespace tilth {
namespace {

constexpr float kBrightest = 1e9F;    // above that of any sensor
constexpr int kMostInMean = 8;        // returns
constexpr float kWidest = 0.2F;       // [m] from the first return of a mean to its last
constexpr float kLargestBend = 0.1F;  // [m] that a range may depart from the two before it

/// Whether `next` goes on with the surface of the returns before it, `from` the first of a mean.
bool goes_on(const std::vector<BeamReturn>& ring, std::size_t from, std::size_t next) {
  if (next - from >= kMostInMean || (ring[next].point - ring[from].point).norm() > kWidest) return false;
  const float range = ring[next].point.norm(), before = ring[next - 1].point.norm();
  if (next - from < 2) return std::abs(range - before) < kLargestBend;
  return std::abs(range - 2 * before + ring[next - 2].point.norm()) < kLargestBend;
}

/// Means of successive returns: a row of the calibration is a mean anyhow, and this one is had for less.
std::vector<BeamReturn> means_of(const std::vector<BeamReturn>& ring) {
  std::vector<BeamReturn> means;
  for (std::size_t from = 0; from < ring.size();) {
    std::size_t end = from + 1;
    BeamReturn mean = ring[from];
    for (; end < ring.size() && goes_on(ring, from, end); ++end) {
      mean.point += ring[end].point, mean.time += ring[end].time, mean.intensity += ring[end].intensity;
    }
    const auto count = float(end - from);
    mean.point /= count, mean.time /= count, mean.intensity /= count;
    mean.count = std::uint16_t(end - from);
    means.push_back(mean);
    from = end;
  }
  return means;
}

}  // namespace

std::vector<BeamReturn> choose_returns(const PointCloud& cloud, const ReturnChoice& choice) {
  const bool timed = cloud.has_times(), lit = cloud.intensities.size() == cloud.size();
  std::vector<std::vector<BeamReturn>> rings;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double range = cloud.points[i].norm();
    if (!(range >= choice.min_range && range <= choice.max_range)) continue;
    const std::uint16_t ring = cloud.rings[i];
    if (ring >= rings.size()) rings.resize(ring + std::size_t{1});
    const float intensity = lit ? cloud.intensities[i] : kBrightest;
    rings[ring].push_back({cloud.points[i].cast<float>(), timed ? cloud.times[i] : 0.0F, intensity, ring});
  }
  std::size_t within = 0;
  for (std::vector<BeamReturn>& ring : rings) ring = means_of(ring), within += ring.size();
  // Ring by ring: every fourth return in the order of firing would be of every fourth ring.
  const double share = within > choice.most ? double(choice.most) / double(within) : 1.0;
  std::vector<BeamReturn> chosen;
  for (const std::vector<BeamReturn>& ring : rings) {
    const auto some = evenly_chosen<BeamReturn>(ring, std::size_t(share * double(ring.size()) + 0.5));
    chosen.insert(chosen.end(), some.begin(), some.end());
  }
  return chosen;
}

}  // namespace tilth

#include <array>
#include <cmath>
#include <numbers>

#include <tilth/sensor/azimuth_arc.hpp>

namespace tilth {
namespace {

constexpr std::size_t kBins = 360;
constexpr double kBin = 2 * std::numbers::pi / double(kBins);

}  // namespace

AzimuthArc arc_of(std::span<const Eigen::Vector3d> points) {
  std::array<bool, kBins> seen{};
  for (const Eigen::Vector3d& p : points)
    seen[std::size_t((std::atan2(p.y(), p.x()) + std::numbers::pi) / kBin) % kBins] = true;
  std::size_t longest = 0, end_of_longest = 0, run = 0;
  for (std::size_t i = 0; i < 2 * kBins && run < kBins; ++i) {
    run = seen[i % kBins] ? 0 : run + 1;
    if (run > longest) longest = run, end_of_longest = i + 1;
  }
  if (longest >= kBins) return {};
  return {double(end_of_longest % kBins) * kBin - std::numbers::pi, double(kBins - longest) * kBin};
}

}  // namespace tilth

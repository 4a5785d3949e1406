#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <tilth/sensor/beams.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Of a histogram: the width of a bin and the sigma of its smoothing [rad].
struct Resolution {
  double bin, sigma;
};
constexpr std::array kResolutions{Resolution{0.02 * kDegree, 0.4 * kDegree}, Resolution{0.02 * kDegree, 0.2 * kDegree},
                                  Resolution{0.02 * kDegree, 0.1 * kDegree}, Resolution{0.02 * kDegree, 0.05 * kDegree},
                                  Resolution{0.005 * kDegree, 0.02 * kDegree}};  ///< coarsest first
constexpr double kValley = 0.6;          ///< of the lower peak: a shallower valley parts no beams
constexpr double kSmallestRatio = 5e-4;  ///< of all points on a beam
constexpr double kLargestSpread = 0.15;  ///< rms distance from the beam over the spacing; 0.29 without beams
constexpr double kClearRatio = 0.95;     ///< of the points on narrow beams: as good as it gets
constexpr double kLeastRatio = 0.8;      ///< where the lowest beams blur on near ground
constexpr std::size_t kFewestBeams = 8, kMostBeams = 128;

struct Histogram {
  double lowest = 0.0, width = 0.0;  ///< [rad] of the first bin, of each
  std::vector<double> counts;
  double centre(std::size_t bin) const { return lowest + (double(bin) + 0.5) * width; }
};

Histogram histogram(std::span<const double> elevations, double width) {
  const auto [low, high] = std::minmax_element(elevations.begin(), elevations.end());
  Histogram h{*low - 50 * width, width, {}};
  h.counts.resize(std::size_t((*high - *low) / width) + 101, 0.0);
  for (const double e : elevations) h.counts[std::size_t((e - h.lowest) / width)] += 1.0;
  return h;
}

Histogram smoothed(const Histogram& h, double sigma) {
  const int reach = int(3.0 * sigma / h.width);
  std::vector<double> kernel;
  for (int k = -reach; k <= reach; ++k) kernel.push_back(std::exp(-0.5 * std::pow(k * h.width / sigma, 2)));
  Histogram out{h.lowest, h.width, std::vector<double>(h.counts.size(), 0.0)};
  for (std::size_t i = 0; i < h.counts.size(); ++i) {
    if (h.counts[i] == 0.0) continue;
    for (int k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t j = std::ptrdiff_t(i) + k;
      if (j >= 0 && std::size_t(j) < out.counts.size())
        out.counts[std::size_t(j)] += h.counts[i] * kernel[std::size_t(k + reach)];
    }
  }
  return out;
}

/// Bins of the peaks parted by valleys deep enough.
std::vector<std::size_t> peaks(const Histogram& h) {
  std::vector<std::size_t> found;
  double valley = 0.0;  // lowest count since the last peak
  for (std::size_t i = 1; i + 1 < h.counts.size(); ++i) {
    const double count = h.counts[i];
    valley = std::min(valley, count);
    if (count <= h.counts[i - 1] || count < h.counts[i + 1]) continue;
    const bool apart = found.empty() || valley < kValley * std::min(count, h.counts[found.back()]);
    if (apart)
      found.push_back(i);
    else if (count > h.counts[found.back()])
      found.back() = i;
    if (apart || found.back() == i) valley = count;
  }
  return found;
}

/// Centres with points enough to be beams.
std::vector<double> frequent(std::span<const double> elevations, std::span<const double> centres) {
  std::vector<std::size_t> count(centres.size(), 0);
  for (const double e : elevations) ++count[nearest_beam(centres, e)];
  const double least = std::max(10.0, kSmallestRatio * double(elevations.size()));
  std::vector<double> beams;
  for (std::size_t b = 0; b < centres.size(); ++b) {
    if (double(count[b]) >= least) beams.push_back(centres[b]);
  }
  return beams;
}

/// Share of the points on beams that are narrow beside the distance to the next beam.
double ratio_on_narrow_beams(std::span<const double> elevations, std::span<const double> beams) {
  std::vector<double> squares(beams.size(), 0.0);
  std::vector<std::size_t> count(beams.size(), 0);
  for (const double e : elevations) {
    const std::size_t b = nearest_beam(beams, e);
    squares[b] += (e - beams[b]) * (e - beams[b]);
    ++count[b];
  }
  std::size_t narrow = 0;
  for (std::size_t b = 0; b < beams.size(); ++b) {
    if (std::sqrt(squares[b] / double(count[b])) < kLargestSpread * spacing_at(beams, b)) narrow += count[b];
  }
  return double(narrow) / double(elevations.size());
}

}  // namespace

double elevation_of(const Eigen::Vector3d& point) {
  return std::atan2(point.z(), point.head<2>().norm());
}

std::size_t nearest_beam(std::span<const double> beams, double elevation) {
  const auto above = std::lower_bound(beams.begin(), beams.end(), elevation);
  if (above == beams.begin()) return 0;
  if (above == beams.end()) return beams.size() - 1;
  const std::size_t i = std::size_t(above - beams.begin());
  return elevation - beams[i - 1] <= beams[i] - elevation ? i - 1 : i;
}

double spacing_at(std::span<const double> beams, std::size_t beam) {
  const double below = beam > 0 ? beams[beam] - beams[beam - 1] : beams[beam + 1] - beams[beam];
  const double above = beam + 1 < beams.size() ? beams[beam + 1] - beams[beam] : below;
  return std::min(below, above);
}

std::vector<double> find_beams(std::span<const double> elevations) {
  if (elevations.size() < kFewestBeams * 10) return {};
  std::vector<double> best;
  double best_ratio = kLeastRatio;
  for (const auto [bin_width, sigma] : kResolutions) {
    const Histogram h = smoothed(histogram(elevations, bin_width), sigma);
    std::vector<double> centres;
    for (const std::size_t bin : peaks(h)) centres.push_back(h.centre(bin));
    const std::vector<double> beams = frequent(elevations, centres);
    if (beams.size() < kFewestBeams || beams.size() > kMostBeams) continue;
    const double ratio = ratio_on_narrow_beams(elevations, beams);
    if (ratio > best_ratio) {
      best_ratio = ratio;
      best = beams;
    }
    if (ratio > kClearRatio) break;
  }
  return best;
}

std::vector<std::uint16_t> nearest_beams(std::span<const Eigen::Vector3d> points, std::span<const double> beams) {
  assert(!beams.empty());
  std::vector<double> borders;  // tangents: one division a point and no arctangent
  for (std::size_t b = 1; b < beams.size(); ++b) borders.push_back(std::tan(0.5 * (beams[b - 1] + beams[b])));
  std::vector<std::uint16_t> nearest(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double slope = points[i].z() / points[i].head<2>().norm();
    nearest[i] = std::uint16_t(std::upper_bound(borders.begin(), borders.end(), slope) - borders.begin());
  }
  return nearest;
}

}  // namespace tilth

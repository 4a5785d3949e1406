#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <tilth/core/error.hpp>
#include <tilth/sensor/length_unit.hpp>

namespace tilth {
namespace {

constexpr std::size_t kFewestPoints = 20;
// Sixteen recordings and scenes from a desk to a motorway lie at 0.17 to 1.5 [log m], their heights at -0.5 to 0.4.
constexpr double kMostMetres = 1.85, kMostCentimetres = 3.05, kFewestMillimetres = 3.6;
constexpr double kHighestCentimetres = 2.40, kLowestMillimetres = 2.50;  // [log] between, the height decides

double percentile(std::vector<double>& values, double ratio) {
  const auto at = values.begin() + std::ptrdiff_t(ratio * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double log_of(double value) {
  return std::log10(std::max(value, std::numeric_limits<double>::min()));
}

}  // namespace

std::span<const std::string_view> names_of(LengthUnit) {
  static constexpr std::array<std::string_view, 4> kNames{"auto", "m", "cm", "mm"};
  return kNames;
}

double metres_of(LengthUnit unit) {
  return unit == LengthUnit::millimetres ? 1e-3 : unit == LengthUnit::centimetres ? 1e-2 : 1.0;
}

std::string to_text(LengthUnit unit) {
  static constexpr std::array<const char*, 4> kNames{"auto", "metres", "centimetres", "millimetres"};
  return kNames[std::size_t(unit)];
}

std::optional<ScanExtent> extent_of(std::span<const Eigen::Vector3d> points) {
  std::vector<double> ranges, heights;
  for (const Eigen::Vector3d& p : points) {
    if (!p.allFinite() || p.isZero(0.0)) continue;
    ranges.push_back(p.norm());
    heights.push_back(p.z());
  }
  if (ranges.size() < kFewestPoints) return std::nullopt;
  const double near = percentile(ranges, 0.01), middle = percentile(ranges, 0.5), far = percentile(ranges, 0.99);
  return ScanExtent{(log_of(near) + log_of(middle) + log_of(far)) / 3, log_of(std::abs(percentile(heights, 0.05)))};
}

LengthUnit unit_of_length(const ScanExtent& extent) {
  if (extent.range < kMostMetres) return LengthUnit::metres;
  if (extent.range < kMostCentimetres) return LengthUnit::centimetres;
  if (extent.range > kFewestMillimetres || extent.height > kLowestMillimetres) return LengthUnit::millimetres;
  if (extent.height < kHighestCentimetres) return LengthUnit::centimetres;
  char text[160];
  std::snprintf(text, sizeof text,
                "are not in metres: ranges are about %.0f. Say by --unit cm or --unit mm which of them they are in",
                std::pow(10.0, extent.range));
  throw Error("coordinates", text);
}

LengthUnit unit_after(LengthUnit unit, double usual, const ScanExtent& extent) {
  constexpr double kClearly = 1.0;  // [log] by which another unit must fit better: a tenth
  const auto change = [&](LengthUnit other) { return std::abs(extent.range + std::log10(metres_of(other)) - usual); };
  LengthUnit best = unit;
  for (const LengthUnit other : {LengthUnit::metres, LengthUnit::centimetres, LengthUnit::millimetres}) {
    if (change(other) < change(best)) best = other;
  }
  return change(unit) - change(best) > kClearly ? best : unit;
}

}  // namespace tilth

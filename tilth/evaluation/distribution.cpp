#include <algorithm>
#include <cmath>
#include <numeric>

#include <tilth/evaluation/distribution.hpp>

namespace tilth {
namespace {

double percentile(const std::vector<double>& sorted, double ratio) {
  const double rank = ratio * double(sorted.size() - 1);
  const std::size_t below = std::size_t(std::floor(rank));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], rank - double(below));
}

}  // namespace

Distribution distribution_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {sum / double(values.size()), percentile(values, 0.5), percentile(values, 0.99), values.back()};
}

BoxFigures box_figures(const std::vector<float>& values) {
  if (values.empty()) return {};
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  return {percentile(sorted, 0.01), percentile(sorted, 0.25), percentile(sorted, 0.5),
          percentile(sorted, 0.75), percentile(sorted, 0.99), sum / double(sorted.size())};
}

}  // namespace tilth

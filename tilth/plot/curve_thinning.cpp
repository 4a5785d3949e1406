#include <algorithm>

#include <tilth/plot/curve_thinning.hpp>

namespace tilth {
namespace {

std::vector<std::size_t> ends_and_between(std::size_t size, std::size_t most) {
  std::vector<std::size_t> kept(most);
  for (std::size_t i = 0; i < most; ++i) kept[i] = i * (size - 1) / (most - 1);
  return kept;
}

std::vector<std::size_t> extremes(const std::vector<float>& y, std::size_t most) {
  std::vector<std::size_t> kept{0};
  const std::size_t runs = most / 2 - 1;
  for (std::size_t run = 0; run < runs; ++run) {
    const auto begin = y.begin() + std::ptrdiff_t(run * y.size() / runs);
    const auto end = y.begin() + std::ptrdiff_t((run + 1) * y.size() / runs);
    const auto [low, high] = std::minmax_element(begin, end);
    for (const auto at : {std::min(low, high), std::max(low, high)}) kept.push_back(std::size_t(at - y.begin()));
  }
  kept.push_back(y.size() - 1);
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

std::vector<float> chosen(const std::vector<float>& values, const std::vector<std::size_t>& indices) {
  std::vector<float> out;
  if (values.empty()) return out;
  for (const std::size_t i : indices) out.push_back(values[i]);
  return out;
}

}  // namespace

Curve thinned(const Curve& curve, std::size_t most, PlotKind kind) {
  const bool ordered = kind == PlotKind::lines || kind == PlotKind::path;
  if (!ordered || curve.y.size() <= most || most < 4) return curve;
  const auto kept = kind == PlotKind::path ? ends_and_between(curve.y.size(), most) : extremes(curve.y, most);
  return {curve.name,  chosen(curve.x, kept), chosen(curve.y, kept), chosen(curve.shade, kept),
          curve.truth, curve.behind};
}

}  // namespace tilth

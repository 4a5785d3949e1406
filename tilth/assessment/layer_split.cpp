#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Eigenvalues>

#include <tilth/assessment/layer_split.hpp>
#include <tilth/assessment/point_moments.hpp>

namespace tilth {
namespace {

constexpr std::size_t kFewest = 40;  // points of a cell
constexpr double kUpright = 0.35;    // least eigenvalue over the middle one, below which a cell may hold layers
constexpr float kLevel = 0.5F;       // upwards part of a normal, from which on a surface is no wall: kerbs, steps
constexpr double kShare = 0.2;       // of the points, at least, in either layer
constexpr double kThinnest = 0.04;   // [m] between two layers
constexpr double kWidest = 0.3;      // [m] between two layers
constexpr double kApart = 4.0;       // standard deviations of a layer that lie between two
constexpr double kThick = 0.035;     // [m] standard deviation of a layer, at most
constexpr float kSpot = 0.16F;       // [m] of the wall, in which both layers must be seen
constexpr double kCovered = 0.7;     // of the spots of the layer with fewer of them, that the other covers

struct Layers {
  std::size_t split = 0;           ///< points of the lower layer, in the order of their offsets
  double gap = 0.0, spread = 0.0;  ///< [m] between their means; standard deviation within the thicker one
};

/// The split that leaves the least variance (N. Otsu, 1979) of offsets that ascend.
Layers best_split(const std::vector<double>& offsets) {
  const auto n = double(offsets.size());
  double total = 0, squares = 0;
  for (const double o : offsets) total += o, squares += o * o;
  Layers best;
  double most = -1, sum = 0, square = 0;
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    sum += offsets[i - 1], square += offsets[i - 1] * offsets[i - 1];
    const double low = double(i), high = n - low, a = sum / low, b = (total - sum) / high;
    const double between = low * high * (b - a) * (b - a);
    if (between <= most || low < kShare * n || high < kShare * n) continue;
    most = between;
    const double variance = std::max(square / low - a * a, (squares - square) / high - b * b);
    best = {i, b - a, std::sqrt(std::max(0.0, variance))};
  }
  return best;
}

using Spots = std::set<std::pair<int, int>>;

/// Both layers are seen at the same spots of the wall.
bool cover_each_other(const Spots& a, const Spots& b) {
  std::size_t both = 0;
  for (const auto& spot : a) both += b.count(spot);
  return double(both) >= kCovered * double(std::min(a.size(), b.size()));
}

std::uint32_t median_scan(std::vector<std::uint32_t> scans) {
  std::nth_element(scans.begin(), scans.begin() + std::ptrdiff_t(scans.size() / 2), scans.end());
  return scans[scans.size() / 2];
}

/// A layer, seen along `axes`: across the wall and along it.
struct Layer {
  Spots spots;
  double side = 0;  ///< sum of the signs of the sides that it was seen from
  std::vector<std::uint32_t> scans;

  void add(const ScannedPoint& p, const Eigen::Matrix3f& axes) {
    spots.emplace(int(std::floor(p.point.dot(axes.col(1)) / kSpot)), int(std::floor(p.point.dot(axes.col(2)) / kSpot)));
    side += (p.from - p.point).dot(axes.col(0)) > 0 ? 1 : -1;
    scans.push_back(p.scan);
  }
};

}  // namespace

CellLayers layers_of(std::span<const ScannedPoint> cell) {
  if (cell.size() < kFewest) return {};
  PointMoments moments;
  const Eigen::Vector3f origin = cell.front().point;
  for (const ScannedPoint& p : cell) moments.add((p.point - origin).cast<double>());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.covariance());
  if (solver.eigenvalues()[0] > kUpright * solver.eigenvalues()[1]) return {};
  const Eigen::Matrix3f axes = solver.eigenvectors().cast<float>();
  std::vector<std::pair<double, const ScannedPoint*>> across;
  for (const ScannedPoint& p : cell) across.emplace_back((p.point - origin).dot(axes.col(0)), &p);
  std::sort(across.begin(), across.end());
  std::vector<double> offsets;
  for (const auto& [offset, point] : across) offsets.push_back(offset);
  const Layers layers = best_split(offsets);
  const bool upright = std::abs(axes(2, 0)) < kLevel;
  const bool apart = layers.gap >= std::max(kThinnest, kApart * layers.spread) && layers.spread < kThick;
  const bool single = std::sqrt(solver.eigenvalues()[0]) < kThick;
  if (!upright || !apart || layers.gap > kWidest) return {single, {}};
  Layer low, high;
  for (std::size_t i = 0; i < across.size(); ++i) (i < layers.split ? low : high).add(*across[i].second, axes);
  if (low.side * high.side <= 0 || !cover_each_other(low.spots, high.spots)) return {single, {}};
  const std::uint32_t later = std::max(median_scan(low.scans), median_scan(high.scans));
  return {true, DoubledWall{(moments.mean().cast<float>() + origin), layers.gap, later, 1}};
}

}  // namespace tilth

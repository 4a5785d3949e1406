// Crop and the outlier filter; the filter against its formulas written out plainly.
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/preprocess/adapted_threshold.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/neighbor_distances.hpp>
#include <tilth/preprocess/outlier_removal.hpp>

namespace tilth {
namespace {

TEST(Crop, DropsNearFarAndNonFinitePoints) {
  PointCloud cloud;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  cloud.points = {{1, 0, 0}, {0.1, 0, 0}, {nan, 0, 0}, {0, inf, 0}, {50, 0, 0}, {0, 3, 4}};
  cloud.rings = {0, 1, 2, 3, 4, 5};
  const PointCloud cropped = crop_range(cloud, 0.5, 5.0);
  EXPECT_EQ(cropped.rings, (std::vector<std::uint16_t>{0, 5}));
  EXPECT_TRUE(crop_range({}, 0.5, 5.0).empty());
}

// A dense sheet with a few points far off it.
PointCloud sheet_with_outliers(std::size_t outliers) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> u(-2, 2);
  PointCloud cloud;
  for (int i = 0; i < 2000; ++i) cloud.points.push_back({5 + 0.002 * u(rng), u(rng), u(rng)});
  for (std::size_t i = 0; i < outliers; ++i) cloud.points.push_back({2.0 + u(rng) / 2, u(rng), u(rng)});
  return cloud;
}

// The formulas written out plainly, in double precision: keep where a mean is below its threshold.
struct PlainFilter {
  std::vector<double> scale, means, threshold;

  PlainFilter(const PointCloud& cloud, const NeighborTable& table, const OutlierOptions& o) {
    for (const Eigen::Vector3d& p : cloud.points) scale.push_back(o.per_range ? 1 / std::max(p.norm(), 1e-3) : 1.0);
    weigh(table, 0);
    if (o.method == OutlierMethod::weighted) weigh(table, 1 / mean_of(means));
    const double mean = mean_of(means);
    double squares = 0;
    for (const double m : means) squares += (m - mean) * (m - mean);
    const double deviation = std::sqrt(squares / double(means.size() - 1)) + 1e-5;
    std::vector<double> rho(means.size());
    for (std::size_t i = 0; i < rho.size(); ++i)
      rho[i] = double(table.k) / (4.0 / 3 * std::numbers::pi * std::pow(distance(table, i, table.k - 1), 3));
    const double rho_mean = mean_of(rho);
    for (std::size_t i = 0; i < rho.size(); ++i) {
      const double x = rho[i] / rho_mean, g = o.density == DensityTerm::inverse ? 1 / x : 1 - x;
      const bool adapts = o.method == OutlierMethod::weighted && o.density != DensityTerm::none;
      threshold.push_back(mean +
                          o.alpha * deviation * (1 + (adapts ? std::clamp(g, o.density_min, o.density_max) : 0)));
    }
  }

  double distance(const NeighborTable& table, std::size_t i, std::size_t t) const {
    return std::sqrt(double(table.distances(i)[t])) * scale[i];
  }

  void weigh(const NeighborTable& table, double decay) {
    means.assign(table.size(), 0);
    for (std::size_t i = 0; i < means.size(); ++i) {
      double weights = 0;
      for (std::size_t t = 0; t < table.k; ++t) {
        const double d = distance(table, i, t), w = std::exp(-decay * (d - distance(table, i, 0)));
        weights += w;
        means[i] += w * d;
      }
      means[i] /= weights;
    }
  }

  static double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  }
};

std::vector<OutlierOptions> ways_to_filter() {
  std::vector<OutlierOptions> ways;
  for (const bool per_range : {false, true}) {
    ways.push_back({.method = OutlierMethod::plain, .per_range = per_range});
    for (const DensityTerm density : {DensityTerm::none, DensityTerm::inverse, DensityTerm::difference})
      ways.push_back({.method = OutlierMethod::weighted, .density = density, .per_range = per_range});
  }
  return ways;
}

// All but the few points that lie within rounding of their threshold must be decided alike.
void expect_same_decisions(const PointCloud& cloud, const NeighborTable& table, const OutlierOptions& options) {
  const PlainFilter plain(cloud, table, options);
  const auto keep = keep_inliers(cloud, table, options);
  std::size_t near = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_near = std::abs(plain.means[i] - plain.threshold[i]) < 1e-5 * plain.threshold[i];
    near += is_near;
    if (is_near) continue;
    ASSERT_EQ(keep[i] != 0, plain.means[i] <= plain.threshold[i]) << "point " << i << ", k " << table.k;
  }
  EXPECT_LE(near, 3);
}

TEST(OutlierRemoval, DecidesAsTheFormulasWrittenOutPlainly) {
  for (const std::size_t k : {2, 10, 13, 40}) {
    const PointCloud cloud = sheet_with_outliers(21 + k);  // no multiple of any number of lanes
    const NeighborTable table = scan_neighbors(cloud, k);
    for (const OutlierOptions& options : ways_to_filter()) expect_same_decisions(cloud, table, options);
  }
}

TEST(OutlierRemoval, AFilterThatServesScanAfterScanRemembersNone) {
  OutlierFilter filter({.method = OutlierMethod::weighted});
  for (const std::size_t outliers : {30, 5, 64}) {
    const PointCloud cloud = sheet_with_outliers(outliers);
    const NeighborTable table = scan_neighbors(cloud, 10);
    EXPECT_EQ(filter.keep(cloud, table), keep_inliers(cloud, table, {.method = OutlierMethod::weighted}));
    EXPECT_EQ(filter.keep(cloud, RingLayout()), filter.keep(cloud, table));
  }
}

TEST(OutlierRemoval, MeansFollowTheFormula) {
  const PointCloud cloud = sheet_with_outliers(21);
  for (const std::size_t k : {1, 10, 23}) {
    const NeighborTable table = scan_neighbors(cloud, k);
    std::vector<float> scale(cloud.size()), means(cloud.size()), weighted(cloud.size());
    inverse_ranges(cloud.points, scale);
    mean_distances(table, scale, means);
    weighted_mean_distances(table, scale, 3.0f, weighted);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      double weights = 0, weighted_sum = 0, sum = 0;
      for (const float squared : table.distances(i)) {
        const double d = std::sqrt(double(squared)) / cloud.points[i].norm(), w = std::exp(-3 * d);
        weights += w;
        weighted_sum += w * d;
        sum += d;
      }
      EXPECT_NEAR(means[i], sum / double(k), 1e-6 * means[i]) << i;
      EXPECT_NEAR(weighted[i], weighted_sum / weights, 1e-5 * weighted[i]) << i;
    }
  }
  const NeighborTable wide{.k = 300, .indices = {}, .squared_distances = {}};
  EXPECT_THROW(mean_distances(wide, {}, {}), Error);
}

TEST(OutlierRemoval, SpreadsAreThoseOfTheFormula) {
  EXPECT_EQ(spread_of({}).mean, 0);
  std::vector<float> values;
  for (int n = 1; n <= 40; ++n) {
    values.push_back(float(n));
    EXPECT_NEAR(spread_of(values).mean, (n + 1) / 2.0, 1e-12) << n;
    EXPECT_NEAR(spread_of(values).deviation, n > 1 ? std::sqrt(n * (n + 1) / 12.0) : 0.0, 1e-12) << n;
  }
}

// Its weights underflow one by one; had it no finite mean, the threshold would let everything else through.
TEST(OutlierRemoval, TakesAPointHundredsOfMeanDistancesAway) {
  PointCloud cloud = sheet_with_outliers(20);
  cloud.points.push_back({5000, 0, 0});
  const NeighborTable table = scan_neighbors(cloud, 10);
  std::vector<float> means(cloud.size());
  weighted_mean_distances(table, {}, 50.0f, means);
  EXPECT_NEAR(means.back(), 4995, 5);
  const auto keep = keep_inliers(cloud, table, {.method = OutlierMethod::weighted});
  EXPECT_LE(std::count(keep.begin() + 2000, keep.end(), 1), 2);
}

TEST(OutlierRemoval, RemovesWhatIsAloneAndKeepsTheSheet) {
  const PointCloud cloud = sheet_with_outliers(20);
  for (const OutlierMethod method : {OutlierMethod::plain, OutlierMethod::weighted}) {
    for (const DensityTerm density : {DensityTerm::none, DensityTerm::inverse, DensityTerm::difference}) {
      const OutlierOptions options{.method = method, .density = density};
      const auto keep = keep_inliers(cloud, scan_neighbors(cloud, 10), options);
      EXPECT_GE(std::count(keep.begin(), keep.begin() + 2000, 1), 1960);
      EXPECT_LE(std::count(keep.begin() + 2000, keep.end(), 1), 2);
    }
  }
}

TEST(OutlierRemoval, CanBeSwitchedOffAndTakesEmptyClouds) {
  const PointCloud cloud = sheet_with_outliers(20);
  const auto keep = keep_inliers(cloud, scan_neighbors(cloud, 10), {.method = OutlierMethod::none});
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 1), 2020);
  EXPECT_TRUE(keep_inliers({}, scan_neighbors({}, 10), {}).empty());
}

}  // namespace
}  // namespace tilth

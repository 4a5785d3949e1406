// Scans of the scenes: labels that agree with the geometry, determinism, snapshots, every imperfection by its rate.
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

SimulationOptions small(std::string_view scene, OptionValues values) {
  values.try_emplace("columns", "300");
  return simulation_options(scene, values);
}

/// Scene and scan made with that many threads.
LabelledScan scan_with_threads(int threads, std::string_view scene, std::size_t index) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  tbb::task_arena arena(threads);
  return arena.execute([&] { return Simulator(scene, simulation_options(scene, {{"duration", "3"}})).scan(index); });
}

bool same(const LabelledScan& a, const LabelledScan& b) {
  return a.scan.cloud.points == b.scan.cloud.points && a.scan.cloud.times == b.scan.cloud.times &&
         a.scan.cloud.intensities == b.scan.cloud.intensities && a.scan.cloud.rings == b.scan.cloud.rings &&
         a.labels == b.labels;
}

/// Share of the points of each kind over some scans.
std::map<PointKind, double> ratios(const Simulator& simulator, std::size_t scans) {
  std::map<PointKind, double> counts;
  double all = 0;
  for (std::size_t k = 0; k < scans; ++k) {
    for (const std::uint8_t label : simulator.scan(k * simulator.size() / scans).labels) {
      counts[PointKind(label & ~kEdgeBit)] += 1, all += 1;
    }
  }
  for (auto& [kind, count] : counts) count /= all;
  return counts;
}

TEST(SimulateScan, GivesTheSameBytesForOneAndFourThreads) {
  for (const std::string_view scene : {"hospital", "plaza"}) {
    EXPECT_TRUE(same(scan_with_threads(1, scene, 5), scan_with_threads(4, scene, 5))) << scene;
  }
}

TEST(SimulateScan, DependsOnTheSeedAndOnNothingElse) {
  const OptionValues values{{"duration", "2"}, {"seed", "4"}};
  const Simulator first("corridor", small("corridor", values)), second("corridor", small("corridor", values));
  const Simulator other("corridor", small("corridor", {{"duration", "2"}, {"seed", "5"}}));
  EXPECT_TRUE(same(first.scan(7), second.scan(7)));
  EXPECT_FALSE(same(first.scan(7), first.scan(8)));
  EXPECT_FALSE(same(first.scan(7), other.scan(7)));
}

TEST(SimulateScan, CutsALongerRecordingWithoutChangingIt) {
  const Simulator whole("corridor", small("corridor", {})), cut("corridor", small("corridor", {{"duration", "12"}}));
  EXPECT_LT(cut.size(), whole.size());
  EXPECT_TRUE(same(whole.scan(cut.size() - 1), cut.scan(cut.size() - 1)));
}

TEST(SimulateScan, ListsPointsInTheOrderTheyWereFired) {
  const Simulator simulator("plaza", simulation_options("plaza", {{"duration", "1"}}));
  const PointCloud cloud = simulator.scan(0).scan.cloud;
  ASSERT_TRUE(cloud.has_times() && cloud.has_rings());
  EXPECT_TRUE(std::is_sorted(cloud.times.begin(), cloud.times.end()));
  EXPECT_GE(cloud.times.front(), 0);
  EXPECT_LT(cloud.times.back(), 0.1);
}

void expect_agreement(PointKind kind, double range, const Hit& first) {
  const bool pane = first.surface->material == Material::glass;
  const double off = std::abs(range - first.distance);
  const bool agrees = kind == PointKind::surface   ? pane || off < 2e-3
                      : kind == PointKind::outlier ? off > 0.29
                      : kind == PointKind::ghost   ? range > first.distance
                      : kind == PointKind::moving  ? pane || first.moving
                                                   : off > 0;
  EXPECT_TRUE(agrees) << names_of(kind)[std::size_t(kind)] << " at " << range << " m, first met " << first.distance;
}

/// Every plain surface point lies on a surface, every ghost and stray one off it.
TEST(SimulateScan, LabelsAgreeWithTheGeometry) {
  const Simulator simulator("hospital",
                            small("hospital", {{"noise", "0"}, {"quantize", "false"}, {"outliers", "0.05"}}));
  std::map<PointKind, int> seen;
  for (std::size_t k = 20; k < simulator.size(); k += 60) {
    const LabelledScan made = simulator.scan(k);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < made.labels.size(); ++i) {
      const double time = made.scan.stamp + double(made.scan.cloud.times[i]);
      const Pose T = interpolate(simulator.truth(), time);
      rays.push_back({T.translation(), (T.linear() * made.scan.cloud.points[i]).normalized(), time});
    }
    const std::vector<Hit> hits = simulator.world().cast(rays);
    for (std::size_t i = 0; i < made.labels.size(); ++i) {
      const PointKind kind = PointKind(made.labels[i] & ~kEdgeBit);
      expect_agreement(kind, made.scan.cloud.points[i].norm(), hits[i]);
      ++seen[kind];
    }
  }
  for (const PointKind kind : {PointKind::surface, PointKind::outlier, PointKind::ghost, PointKind::moving}) {
    EXPECT_GT(seen[kind], 20) << names_of(kind)[std::size_t(kind)];
  }
}

TEST(SimulateScan, TakesEveryImperfectionAtItsRate) {
  const OptionValues clean{{"outliers", "0"}, {"mixed", "0"}, {"ghosts", "0"}, {"people", "0"}};
  const auto only_surface = ratios(Simulator("corridor", small("corridor", clean)), 5);
  EXPECT_EQ(only_surface.size(), 1u);
  OptionValues strays = clean;
  strays["outliers"] = "0.02", strays["columns"] = "1000";
  EXPECT_NEAR(ratios(Simulator("corridor", small("corridor", strays)), 8).at(PointKind::outlier), 0.02, 0.003);
  OptionValues mixed = clean;
  mixed["mixed"] = "1";
  EXPECT_GT(ratios(Simulator("plaza", small("plaza", mixed)), 5).at(PointKind::mixed), 0.001);
}

TEST(SimulateScan, KeepsMixedPointsBetweenTheTwoSurfaces) {
  const Simulator simulator("plaza", small("plaza", {{"noise", "0"}, {"mixed", "1"}, {"outliers", "0"}}));
  int checked = 0;
  for (std::size_t k = 10; k < simulator.size(); k += 100) {
    const LabelledScan made = simulator.scan(k);
    for (std::size_t i = 0; i < made.labels.size(); ++i) {
      if ((made.labels[i] & ~kEdgeBit) != std::uint8_t(PointKind::mixed)) continue;
      const double time = made.scan.stamp + double(made.scan.cloud.times[i]);
      const Pose T = interpolate(simulator.truth(), time);
      const Ray ray{T.translation(), (T.linear() * made.scan.cloud.points[i]).normalized(), time};
      const double off =
          std::abs(simulator.world().cast(std::span(&ray, 1))[0].distance - made.scan.cloud.points[i].norm());
      EXPECT_GT(off, 0.01);
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST(SimulateScan, SnapshotsShowTheWorldFromOnePose) {
  const Simulator simulator("corridor_fast",
                            simulation_options("corridor_fast", {{"snapshot", "true"}, {"noise", "0"}}));
  const std::size_t index = simulator.size() / 2;
  const LabelledScan made = simulator.scan(index);
  const std::vector<float>& times = made.scan.cloud.times;  // zeros, lest a reader derive some from the order of firing
  EXPECT_EQ(std::count(times.begin(), times.end(), 0.0F), std::ptrdiff_t(made.scan.cloud.size()));
  const Pose T = interpolate(simulator.truth(), made.scan.stamp);
  std::vector<Ray> rays;
  for (const Eigen::Vector3d& p : made.scan.cloud.points) {
    rays.push_back({T.translation(), (T.linear() * p).normalized(), made.scan.stamp});
  }
  const std::vector<Hit> hits = simulator.world().cast(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_NEAR(hits[i].distance, made.scan.cloud.points[i].norm(), 1e-3);
    const double azimuth = -std::atan2(made.scan.cloud.points[i].y(), made.scan.cloud.points[i].x());
    const double column = azimuth / (2 * std::acos(-1.0)) * double(simulator.lidar().columns);
    EXPECT_NEAR(column, std::round(column), 1e-6);
  }
}

TEST(SimulateScan, RoundsRangesToTheStepOfThePackets) {
  const Simulator simulator("corridor", small("corridor", {{"sensor", "leishen_c16"}}));
  const PointCloud cloud = simulator.scan(3).scan.cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double range = (cloud.points[i] - simulator.lidar().origin(cloud.times[i])).norm();
    EXPECT_NEAR(range / 0.0025, std::round(range / 0.0025), 1e-5);
  }
}

TEST(SimulationOptions, AreRefusedByName) {
  EXPECT_THROW(simulation_options("corridor", {{"nosie", "0.1"}}), Error);
  EXPECT_THROW(simulation_options("corridor", {{"noise", "-1"}}), Error);
  EXPECT_THROW(Simulator("corridor", simulation_options("corridor", {{"sensor", "vlp17"}})), Error);
  try {
    simulation_options("corridoor", {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("hospital"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tilth

// Made corridors with known truth: found where they are alike once, never where they are alike many times.
#include <gtest/gtest.h>

#include "localization/made_map.hpp"
#include <tilth/core/median.hpp>
#include <tilth/localization/localizer.hpp>

namespace tilth {
namespace {

const std::vector<double> kDoors{3, 4.7, 9, 13, 14.5, 19, 21, 23.5};

Simulator corridor_drive(const CorridorPlan& plan, double seconds, int seed, const std::string& sensor = "vlp16") {
  const std::vector<Leg> legs{{1, 0, 0}, {seconds, 1.0, 0}, {1, 0, 0}};
  return Simulator(
      corridor_scene(plan, legs),
      simulation_options("corridor",
                         {{"seed", std::to_string(seed)}, {"people", "0"}, {"columns", "600"}, {"sensor", sensor}}));
}

Localizer::MakeOdometry true_odometry(const Simulator& simulator) {
  return [&] { return std::make_unique<DriftingOdometry>(simulator, Drift{}); };
}

LocalizerOptions retrying_every(double seconds) {
  LocalizerOptions options;
  options.retry = seconds;
  return options;
}

/// [m] between where a scan was located and where it was taken, in the map of a drive that began where this one did.
double error_of(const LocatedScan& located, const Simulator& mapped, const Simulator& driven) {
  const Pose T_world_map = interpolate(mapped.truth(), mapped.stamp(0) + 0.5 * mapped.lidar().period);
  const Pose truth = T_world_map.inverse() * interpolate(driven.truth(), located.odometry.stamp);
  return (located.T_map_lidar->translation() - truth.translation()).norm();
}

TEST(Localizer, FindsItselfInTheMiddleOfACorridorAndStaysThere) {
  const CorridorPlan plan{26, kDoors};
  const Simulator mapped = corridor_drive(plan, 20, 301), driven = corridor_drive(plan, 20, 302);
  const MadeMap map = map_of(mapped);
  Localizer localizer(map, true_odometry(driven), {}, std::nullopt);
  double worst = 0;
  std::size_t located = 0;
  for (std::size_t i = 100; i < 180; ++i) {
    const LocatedScan scan = localizer.add(driven.scan(i).scan);
    EXPECT_EQ(scan.T_map_lidar.has_value(), is_known(scan.state));
    if (!scan.T_map_lidar) continue;
    worst = std::max(worst, error_of(scan, mapped, driven));
    ++located;
  }
  EXPECT_GE(located, 50U);
  EXPECT_LT(worst, 0.05);
}

TEST(Localizer, FindsASensorOfManyBeamsInTheMapOfOneOfFew) {
  const CorridorPlan plan{26, kDoors};
  const Simulator mapped = corridor_drive(plan, 20, 312), driven = corridor_drive(plan, 20, 313, "os1_64");
  const MadeMap map = map_of(mapped);
  Localizer localizer(map, true_odometry(driven), {}, std::nullopt);
  std::size_t located = 0;
  for (std::size_t i = 100; i < 130; ++i) {
    const LocatedScan scan = localizer.add(driven.scan(i).scan);
    if (!scan.T_map_lidar) continue;
    EXPECT_LT(error_of(scan, mapped, driven), 0.05) << "at scan " << i;
    ++located;
  }
  EXPECT_GT(located, 10U);
}

TEST(Localizer, CallsIdenticalDoorsAmbiguous) {
  std::vector<double> doors;
  for (double at = 1; at < 58; at += 3) doors.push_back(at);
  const CorridorPlan plan{60, doors, false};
  const Simulator mapped = corridor_drive(plan, 54, 303), driven = corridor_drive(plan, 54, 304);
  const MadeMap map = map_of(mapped);
  Localizer localizer(map, true_odometry(driven), retrying_every(2.0), std::nullopt);
  std::size_t several = 0;
  for (std::size_t i = 250; i < 330; ++i) {
    const LocatedScan scan = localizer.add(driven.scan(i).scan);
    several += scan.state == MapState::ambiguous;
    EXPECT_LT(scan.T_map_lidar ? error_of(scan, mapped, driven) : 0.0, 0.1);
  }
  EXPECT_GT(several, 0U);
}

TEST(Localizer, IsToldWhichOfIdenticalDoors) {
  std::vector<double> doors;
  for (double at = 1; at < 58; at += 3) doors.push_back(at);
  const CorridorPlan plan{60, doors, false};
  const Simulator mapped = corridor_drive(plan, 54, 303), driven = corridor_drive(plan, 54, 304);
  const MadeMap map = map_of(mapped);
  const Pose T_map_first = true_motion(mapped, mapped.stamp(0), mapped.stamp(250));
  LocalizerOptions options;
  options.at_radius = 1.4;  // half way to the next one
  Localizer localizer(map, true_odometry(driven), options, T_map_first);
  std::size_t located = 0;
  for (std::size_t i = 250; i < 280; ++i) {
    const LocatedScan scan = localizer.add(driven.scan(i).scan);
    if (!scan.T_map_lidar) continue;
    EXPECT_LT(error_of(scan, mapped, driven), 0.1);
    ++located;
  }
  EXPECT_GT(located, 0U);
}

TEST(Localizer, DoesNotFindAnotherCorridorInTheMap) {
  const Simulator mapped = corridor_drive({26, kDoors}, 20, 305);
  const Simulator elsewhere = corridor_drive({40, {2, 5.5, 8, 11, 17.5, 22, 24, 28.5, 33}, false}, 30, 306);
  const MadeMap map = map_of(mapped);
  Localizer localizer(map, true_odometry(elsewhere), retrying_every(2.0), std::nullopt);
  for (std::size_t i = 120; i < 200; ++i) {
    const LocatedScan scan = localizer.add(elsewhere.scan(i).scan);
    EXPECT_FALSE(scan.T_map_lidar.has_value()) << "at scan " << i;
  }
}

// Shifted, a corridor of another size fits most of the map's walls.
TEST(Localizer, DoesNotBelieveScansOfAnotherSize) {
  const CorridorPlan plan{26, kDoors};
  const Simulator mapped = corridor_drive(plan, 20, 308), driven = corridor_drive(plan, 20, 309);
  const MadeMap map = map_of(mapped);
  for (const double size : {0.85, 0.95, 1.04, 1.1}) {
    const auto odometry = [&] { return std::make_unique<DriftingOdometry>(driven, Drift{.scale = size - 1}); };
    Localizer localizer(map, odometry, {}, std::nullopt);
    std::vector<double> scales;
    for (std::size_t i = 100; i < 130; ++i) {
      Scan scan = driven.scan(i).scan;
      for (Eigen::Vector3d& point : scan.cloud.points) point *= size;
      const LocatedScan located = localizer.add(scan);
      EXPECT_FALSE(located.T_map_lidar.has_value()) << "size " << size << ", scan " << i;
      if (!located.hypotheses.empty()) scales.push_back(located.hypotheses.front().scale.value());
    }
    ASSERT_FALSE(scales.empty());
    EXPECT_GT(std::abs(median(scales) - 1), 0.02) << "size " << size;
  }
}

TEST(Localizer, RefusesAMapWithoutPlaces) {
  const Simulator driven = corridor_drive({26, kDoors}, 20, 307);
  const MadeMap empty;
  EXPECT_THROW(Localizer(empty, true_odometry(driven), {}, std::nullopt), Error);
}

}  // namespace
}  // namespace tilth

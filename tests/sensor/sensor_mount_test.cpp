// The mounting of a spinning sensor found again in clouds of whatever frame and order, and not where there is none.
#include <algorithm>
#include <numbers>
#include <random>
#include <sensor/spinning_lidar.hpp>

#include <gtest/gtest.h>

#include <tilth/sensor/beams.hpp>
#include <tilth/sensor/ring_convention.hpp>
#include <tilth/sensor/sensor_mount.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
using Order = std::function<void(std::vector<Shot>&)>;

Eigen::Isometry3d mounted(const Eigen::Vector3d& origin, double degrees, const Eigen::Vector3d& about) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(degrees * kDegree, about.normalized()).toRotationMatrix();
  T.translation() = origin;
  return T;
}

/// Rooms of 16 x 10 x 4 m seen from 0.6 m ahead of their centre and 0.7 m below, in the frame of the cloud.
std::vector<MeasuredPoints> clouds(const std::vector<double>& beams, const Eigen::Isometry3d& T_cloud_sensor,
                                   const Order& order, bool with_rings) {
  std::vector<MeasuredPoints> scans;
  for (int k = 0; k < 3; ++k) {
    std::vector<Shot> shots = shots_of({.elevations_deg = beams, .start_deg = 20.0 * k, .columns = 900});
    for (Shot& shot : shots) {  // the same beam, met by walls that are not the same all around
      const Eigen::Vector3d direction = shot.point.normalized(), half(8, 5, 2), centre(-0.6, 0.4, 0.7);
      double range = 100;
      for (int axis = 0; axis < 3; ++axis) {
        const double wall = centre[axis] + std::copysign(half[axis], direction[axis]);
        range = std::min(range, wall / direction[axis] > 0 ? wall / direction[axis] : 100.0);
      }
      shot.point = range * direction;
    }
    if (order) order(shots);
    MeasuredPoints& scan = scans.emplace_back();
    for (const Shot& shot : shots) {
      scan.points.push_back((T_cloud_sensor * shot.point).cast<float>().cast<double>());
      if (with_rings) scan.ring_values.push_back(shot.ring);
    }
  }
  return scans;
}

/// [m, deg] between origins and axes, whichever way the latter point.
std::pair<double, double> off(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth) {
  const double cosine = std::abs(found.linear().col(2).dot(truth.linear().col(2)));
  return {(found.translation() - truth.translation()).norm(), std::acos(std::min(1.0, cosine)) / kDegree};
}

PointFieldRoles ring_field(const std::string& name) {
  PointFieldRoles roles;
  roles.ring = PointField{name, FieldType::u16, 12};
  return roles;
}

void shuffle(std::vector<Shot>& shots) {
  std::shuffle(shots.begin(), shots.end(), std::mt19937(3));
}

void sort_by_x(std::vector<Shot>& shots) {
  std::sort(shots.begin(), shots.end(), [](const Shot& a, const Shot& b) { return a.point.x() < b.point.x(); });
}

const std::vector<double> kSixteen = beams_deg(16, -15, 2), kEight = beams_deg(8, -15, 4);
const std::vector<double> kFine = beams_deg(96, -7, 0.11);
const std::vector<Eigen::Isometry3d> kMounts{
    mounted({0.5, 0, 1.2}, 0, {0, 0, 1}),   mounted({1.5, 0.3, 0.8}, 11, {0.2, 1, 0}),
    mounted({0, 0, 0}, 30, {0, 1, 0}),      mounted({0.2, 0.1, 0}, 45, {1, 1, 0}),
    mounted({0, 0, 0}, 90, {0, 1, 0}),      mounted({1, 0, 1}, 90, {1, 0, 0}),
    mounted({0.5, 0, 1.2}, 180, {1, 0, 0}), mounted({-1, 0.4, 0.6}, 60, {1, 0.3, 0})};

TEST(SensorMount, IsFoundInWhateverFrameAndOrder) {
  for (const std::vector<double>& beams : {kSixteen, kEight}) {
    for (const Eigen::Isometry3d& mount : kMounts) {
      for (const Order& order : {Order{}, Order{shuffle}, Order{sort_by_x}}) {
        const auto found = find_mount(clouds(beams, mount, order, false));
        ASSERT_TRUE(found) << beams.size() << " beams\n" << mount.matrix();
        EXPECT_EQ(found->beams.size(), beams.size());
        EXPECT_LT(off(found->T_cloud_sensor, mount).first, 0.005) << mount.matrix();
        EXPECT_LT(off(found->T_cloud_sensor, mount).second, 0.05) << mount.matrix();
      }
    }
  }
}

TEST(SensorMount, OfBeamsNearerToOneAnotherThanTheirPoints) {
  for (const Eigen::Isometry3d& mount : kMounts) {  // columns are 0.4 degrees apart
    const auto found = find_mount(clouds(kFine, mount, {}, false));
    ASSERT_TRUE(found) << mount.matrix();
    EXPECT_EQ(found->beams.size(), kFine.size());
    EXPECT_LT(off(found->T_cloud_sensor, mount).first, 0.002);
  }
}

TEST(SensorMount, OfKnownRingsIsFoundAtAnyTilt) {
  for (const Eigen::Isometry3d& mount : kMounts) {
    const auto found = find_mount_of_rings(clouds(kSixteen, mount, shuffle, true));
    ASSERT_TRUE(found) << mount.matrix();
    EXPECT_LT(off(*found, mount).first, 0.005);
    EXPECT_LT(off(*found, mount).second, 0.05);
  }
}

TEST(SensorMount, IsNotFoundWhereNothingSpins) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> even(-1, 1);
  std::vector<MeasuredPoints> noise(2), two_sensors = clouds(kSixteen, kMounts[1], {}, false);
  for (MeasuredPoints& scan : noise) {
    for (int i = 0; i < 8000; ++i) scan.points.emplace_back(8 * even(random), 8 * even(random), 2 * even(random));
  }
  EXPECT_FALSE(find_mount(noise));
  const std::vector<MeasuredPoints> second = clouds(kSixteen, mounted({-1, 0, 0.4}, 35, {0, 1, 0}), {}, false);
  for (std::size_t k = 0; k < two_sensors.size(); ++k) {
    auto& points = two_sensors[k].points;
    points.insert(points.end(), second[k].points.begin(), second[k].points.end());
  }
  EXPECT_FALSE(find_mount(two_sensors)) << "of two sensors in one cloud neither is all of it";
}

TEST(Rings, OfMovedCloudsAreThoseOfTheBeams) {
  for (const bool with_field : {false, true}) {
    const std::vector<MeasuredPoints> scans = clouds(kSixteen, kMounts[4], {}, true);
    std::vector<MeasuredPoints> seen = scans;
    const PointFieldRoles roles = with_field ? ring_field("ring") : PointFieldRoles{};
    if (!with_field) {
      for (MeasuredPoints& scan : seen) scan.ring_values.clear();
    }
    const RingConvention convention(seen, roles);
    ASSERT_TRUE(convention.T_cloud_sensor());
    EXPECT_NE(convention.decision().find("tilted by 90.0 deg found in the points"), std::string::npos)
        << convention.decision();
    const std::vector<std::uint16_t> rings = convention.rings_of(seen[0]);
    const bool upright = convention.T_cloud_sensor()->linear().col(2).dot(kMounts[4].linear().col(2)) > 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const int ring = int(scans[0].ring_values[i]);
      wrong += rings[i] != (upright ? ring : 15 - ring);
    }
    EXPECT_EQ(wrong, 0u) << with_field;
  }
}

TEST(Rings, OfCloudsInTheSensorsOwnFrameNeedNoMount) {
  const std::vector<MeasuredPoints> scans = clouds(kSixteen, Eigen::Isometry3d::Identity(), {}, true);
  EXPECT_FALSE(RingConvention(scans, ring_field("ring")).T_cloud_sensor());
  EXPECT_FALSE(RingConvention(scans, PointFieldRoles{}).T_cloud_sensor());
  EXPECT_EQ(RingConvention(clouds(kFine, Eigen::Isometry3d::Identity(), {}, false), PointFieldRoles{}).decision(),
            "ring: no field, derived from elevation: 96 beams");
}

TEST(Rings, AFieldOfLinesThatAreNoRingsIsNotBelieved) {
  std::vector<MeasuredPoints> scans = clouds(kSixteen, Eigen::Isometry3d::Identity(), shuffle, true);
  std::mt19937 random(6);
  for (MeasuredPoints& scan : scans) std::shuffle(scan.ring_values.begin(), scan.ring_values.end(), random);
  const RingConvention convention(scans, ring_field("line"));
  EXPECT_EQ(convention.decision(), "ring: field 'line' names no rings, derived from elevation: 16 beams");
}

}  // namespace
}  // namespace tilth

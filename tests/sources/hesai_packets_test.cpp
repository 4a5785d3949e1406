// Packets of a real Hesai PandarXT-16; skipped by name where they are not at hand.
#include <cmath>

#include <gtest/gtest.h>

#include "support/real_recording.hpp"
#include <tilth/io/pcd.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {
namespace {

constexpr double kSpin = 20 * 3.14159265358979;  // [rad/s] 600 turns a minute, as its packets tell
constexpr double kChannelPeriod = 3.024e-6;      // [s]
constexpr double kAtTheCut = 1e-4;               // [rad]

Eigen::Vector3d turned(const Eigen::Vector3d& p, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * p;
}

std::vector<Scan> scans_of(const std::string& path) {
  const auto source = open_source(path, {});
  std::vector<Scan> scans;
  while (std::optional<Scan> scan = source->next()) scans.push_back(std::move(*scan));
  return scans;
}

/// The other decoder leaves x to the right and y forward, and gives all shots of a firing the azimuth of its first;
/// ours are turned on by the time since then, as the maker's manual asks. Its cloud begins one firing later than ours.
TEST(RealHesaiPackets, ADualReturnBagGivesTheCloudThatAnotherDecoderMade) {
  const std::string bag = recording("packets-small/nebula_hesai_xt16_4scans.db3").string();
  const std::string pcd = recording("packets-small/nebula_hesai_xt16_1732848128093928016.pcd").string();
  NEEDS(bag);
  NEEDS(pcd);
  const std::vector<Scan> scans = scans_of(bag);
  ASSERT_EQ(scans.size(), 3U);
  const PointCloud& ours = scans[1].cloud;
  const PointRecords theirs = read_pcd(pcd);
  ASSERT_EQ(ours.size(), theirs.count);
  std::vector<std::vector<double>> xyz;
  for (const char* name : {"x", "y", "z"}) xyz.push_back(column(theirs, *theirs.find(name)));
  std::size_t begin = 0, at_the_cut = 0;  // both clouds are in the order of firing
  while (std::abs(std::atan2(ours.points[begin].y(), ours.points[begin].x())) < 0.0018) ++begin;
  for (std::size_t i = 0; i < theirs.count; ++i) {
    const Eigen::Vector3d point(xyz[1][i], -xyz[0][i], xyz[2][i]);
    if (std::abs(std::atan2(point.y(), point.x())) < kAtTheCut) {
      ++at_the_cut;
      continue;
    }
    double nearest = 1.0;
    for (std::size_t k = i; k < std::min(ours.size(), i + 2 * begin + 4); ++k) {
      const double since_firing = (15 - ours.rings[k]) * kChannelPeriod;
      nearest = std::min(nearest, (turned(ours.points[k], kSpin * since_firing) - point).norm());
    }
    ASSERT_LT(nearest, 0.002) << "point " << i;
  }
  EXPECT_LE(at_the_cut, 32U);
}

TEST(RealHesaiPackets, TurnsFollowOneAnotherWithRingTimeAndIntensity) {
  const std::string bag = recording("packets-small/nebula_hesai_xt16_4scans.db3").string();
  NEEDS(bag);
  const std::vector<Scan> scans = scans_of(bag);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const PointCloud& cloud = scans[i].cloud;
    ASSERT_TRUE(cloud.has_rings() && cloud.has_times() && cloud.intensities.size() == cloud.size());
    EXPECT_TRUE(std::is_sorted(cloud.times.begin(), cloud.times.end()));
    EXPECT_NEAR(cloud.times.back(), 0.1, 0.001);
    EXPECT_NEAR(scans[i].stamp, 1564027949.299745 + 0.1 * double(i), 1e-4);
  }
}

}  // namespace
}  // namespace tilth

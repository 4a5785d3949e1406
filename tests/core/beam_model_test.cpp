#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <tilth/core/beam_model.hpp>
#include <tilth/core/error.hpp>

namespace tilth {
namespace {

BeamModel flawed() {
  BeamModel beams;
  beams.range = {0.02, -0.03, 0.01};
  beams.elevation = {0.003, -0.002, 0.001};
  beams.azimuth = {-0.001, 0.0, 0.002};
  beams.encoder = {0.0005, -0.0004, 0.0002, 0.0001};
  beams.range_scale = 0.001, beams.walk = 0.02, beams.bright = 100;
  return beams;
}

/// What the law of beam_model.hpp makes of a true point, with the azimuth found by iteration.
Eigen::Vector3d measured(const BeamModel& b, const Eigen::Vector3d& p, std::size_t ring, double intensity) {
  const double el = std::asin(p.z() / p.norm()) + b.elevation[ring], az = std::atan2(p.y(), p.x());
  double a = az;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector4d h(std::cos(a), std::sin(a), std::cos(2 * a), std::sin(2 * a));
    a = az + b.azimuth[ring] + h.dot(b.encoder);
  }
  const double q = 1 - std::min(intensity / b.bright, 1.0);
  const double r = (1 + b.range_scale) * p.norm() + b.range[ring] + b.walk * q;
  return r * Eigen::Vector3d(std::cos(el) * std::cos(a), std::cos(el) * std::sin(a), std::sin(el));
}

TEST(BeamModel, WhatFlawedBeamsMeasureIsCorrectedToTheTruePoint) {
  const BeamModel beams = flawed();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-20, 20), light(0, 255);
  PointCloud truth, seen;
  for (int i = 0; i < 300; ++i) {
    truth.points.emplace_back(at(random), at(random), 0.2 * at(random));
    truth.rings.push_back(std::uint16_t(i % 3));
    truth.intensities.push_back(float(light(random)));
    seen.points.push_back(measured(beams, truth.points.back(), truth.rings.back(), truth.intensities.back()));
  }
  seen.rings = truth.rings, seen.intensities = truth.intensities;
  const PointCloud back = corrected(seen, beams);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_LT((back.points[i] - truth.points[i]).norm(), 1e-9) << i;
}

TEST(BeamModel, DirectionAndRangeAreTheTwoHalvesOfTheSameLaw) {
  const BeamModel beams = flawed();
  const Eigen::Vector3d nominal = Eigen::Vector3d(1, 2, -0.3).normalized();
  const Eigen::Vector3d truth = 7.0 * true_direction(beams, 1, nominal);
  EXPECT_NEAR(truth.norm(), 7.0, 1e-12);
  const Eigen::Vector3d seen = reported_range(beams, 1, 7.0, 30) * nominal;
  EXPECT_LT((seen - measured(beams, truth, 1, 30)).norm(), 1e-9);
}

TEST(BeamModel, IdealBeamsChangeNotABit) {
  PointCloud cloud;
  cloud.points = {{1.1, 2.2, 3.3}, {0, 0, 5}};
  BeamModel zeros;
  zeros.range.assign(16, 0.0), zeros.elevation.assign(16, 0.0);
  EXPECT_TRUE(zeros.ideal());
  EXPECT_EQ(corrected(cloud, zeros).points, cloud.points);
}

TEST(BeamModel, PointsOnTheAxisAndAtTheOriginStayFinite) {
  PointCloud cloud;
  cloud.points = {{0, 0, 5}, {0, 0, 0}, {0, 0, -2}};
  cloud.rings = {0, 1, 2};
  for (const Eigen::Vector3d& p : corrected(cloud, flawed()).points) EXPECT_TRUE(p.allFinite());
}

TEST(BeamModel, RefusesACloudOfOtherBeams) {
  PointCloud cloud;
  cloud.points = {{1, 0, 0}};
  EXPECT_THROW(corrected(cloud, flawed()), Error);
  cloud.rings = {3};
  EXPECT_THROW(corrected(cloud, flawed()), Error);
}

}  // namespace
}  // namespace tilth

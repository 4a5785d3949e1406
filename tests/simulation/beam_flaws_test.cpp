// Beams with constant errors: drawn as asked, reported as the law of beam_model.hpp says, and gone once corrected.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHalf = 6.0;  // [m] half the side of the square room

const MeshWorld& room() {
  static const MeshWorld world = [] {
    Mesh mesh;
    const SurfaceId wall = add_surface(mesh, {"wall"});
    const std::array<Vector3d, 4> corners{Vector3d(-kHalf, -kHalf, -20), Vector3d(kHalf, -kHalf, -20),
                                          Vector3d(kHalf, kHalf, -20), Vector3d(-kHalf, kHalf, -20)};
    for (std::size_t i = 0; i < 4; ++i) add_wall(mesh, wall, {corners[i], corners[(i + 1) % 4], 40.0, {}});
    return MeshWorld(std::move(mesh), {});
  }();
  return world;
}

NoiseOptions noiseless() {
  NoiseOptions options = gazebo_noise();
  options.noise = 0;
  return options;
}

/// A snapshot from a place off the middle of the room.
const Pose kPose = upright({1.0, -2.0, 0.0}, 0.3);

PointCloud seen(const FlawedLidar& sensor) {
  return simulate_scan(room(), sensor, {{0, kPose}}, noiseless(), {0, 5, 0}).scan.cloud;
}

FlawedLidar flawed(const BeamFlawOptions& options) {
  return flawed_lidar(vlp16(), options, 11);
}

double off_the_walls(const Vector3d& p) {
  return std::max(std::abs(p.x()), std::abs(p.y())) - kHalf;
}

double deviation(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / double(values.size()));
}

/// What a range reads too long, expected of every point beside the direction, which stays what it was.
template <class F>
void expect_longer(const BeamFlawOptions& options, const F& excess) {
  const FlawedLidar sensor = flawed(options);
  const PointCloud ideal = seen({vlp16()}), measured = seen(sensor);
  ASSERT_EQ(measured.size(), ideal.size());
  for (std::size_t i = 0; i < ideal.size(); ++i) {
    const Vector3d& p = ideal.points[i];
    const Vector3d expected = (1 + excess(sensor.beams, ideal, i) / p.norm()) * p;
    ASSERT_LT((measured.points[i] - expected).norm(), 1e-9) << i;
  }
}

TEST(DrawBeams, HaveTheDeviationAsked) {
  BeamFlawOptions options;
  options.beam_range = 0.02, options.beam_elevation = 0.15, options.beam_azimuth = 0.05, options.encoder = 0.03;
  const BeamModel beams = draw_beams(options, 4000, 3);
  EXPECT_NEAR(deviation(beams.range), 0.02, 0.001);
  EXPECT_NEAR(deviation(beams.elevation), 0.15 * kDegree, 0.007 * kDegree);
  EXPECT_NEAR(deviation(beams.azimuth), 0.05 * kDegree, 0.003 * kDegree);
  std::vector<double> first, second;
  for (std::uint64_t seed = 1; seed < 2000; ++seed) {
    const Eigen::Vector4d encoder = draw_beams(options, 16, seed).encoder;
    first.insert(first.end(), {encoder[0], encoder[1]});
    second.insert(second.end(), {encoder[2], encoder[3]});
  }
  EXPECT_NEAR(deviation(first), 0.03 * kDegree, 0.0015 * kDegree);
  EXPECT_NEAR(deviation(second), 0.015 * kDegree, 0.0008 * kDegree);
}

TEST(DrawBeams, DependOnTheSeedAndTheirOwnDeviationAlone) {
  const BeamFlawOptions worn = flaws_of(BeamPreset::worn);
  const BeamModel beams = draw_beams(worn, 16, 3);
  EXPECT_EQ(beams.range, draw_beams(worn, 16, 3).range);
  EXPECT_NE(beams.range, draw_beams(worn, 16, 4).range);
  BeamFlawOptions more = worn;
  more.beam_range *= 2, more.encoder = 0;
  EXPECT_EQ(draw_beams(more, 16, 3).elevation, beams.elevation);
  EXPECT_EQ(draw_beams(more, 16, 3).encoder, Eigen::Vector4d::Zero());
  for (std::size_t ring = 0; ring < 16; ++ring)
    EXPECT_DOUBLE_EQ(draw_beams(more, 16, 3).range[ring], 2 * beams.range[ring]);
  EXPECT_TRUE(beams.azimuth.empty());
}

TEST(DrawBeams, AreThoseOfTheirOwnSeedInEveryScene) {
  BeamFlawOptions options = flaws_of(BeamPreset::worn);
  EXPECT_EQ(flawed_lidar(vlp16(), options, 5).beams.range, draw_beams(options, 16, 5).range);
  options.beam_seed = 7;
  EXPECT_EQ(flawed_lidar(vlp16(), options, 5).beams.range, draw_beams(options, 16, 7).range);
}

TEST(BeamFlaws, AreOffBitByBit) {
  FlawedLidar zeros{vlp16()};
  zeros.beams.range.assign(16, 0.0), zeros.beams.elevation.assign(16, 0.0), zeros.beams.bright = 90;
  const NoiseOptions plain;
  const auto scan = [&](const FlawedLidar& sensor) {
    return simulate_scan(room(), sensor, {{0, kPose}}, plain, {0, 5, 0});
  };
  const LabelledScan ideal = scan({vlp16()});
  for (const FlawedLidar& sensor : {zeros, flawed({})}) {
    EXPECT_TRUE(sensor.ideal());
    EXPECT_EQ(scan(sensor).scan.cloud.points, ideal.scan.cloud.points);
    EXPECT_EQ(scan(sensor).scan.cloud.intensities, ideal.scan.cloud.intensities);
    EXPECT_EQ(scan(sensor).labels, ideal.labels);
  }
  EXPECT_TRUE(Simulator("corridor", simulation_options("corridor", {{"duration", "1"}})).beams().ideal());
}

TEST(BeamFlaws, RangesReadLongByTheErrorOfTheirBeam) {
  BeamFlawOptions options;
  options.beam_range = 0.02;
  expect_longer(options, [](const BeamModel& beams, const PointCloud& cloud, std::size_t i) {
    return beams.range[cloud.rings[i]];
  });
}

TEST(BeamFlaws, RangesReadLongByTheScale) {
  BeamFlawOptions options;
  options.range_scale = -0.003;
  expect_longer(options, [](const BeamModel&, const PointCloud& cloud, std::size_t i) {
    return -0.003 * cloud.points[i].norm();
  });
}

TEST(BeamFlaws, DarkReturnsWalk) {
  BeamFlawOptions options;
  options.walk = 0.02;
  double most = 0;
  expect_longer(options, [&](const BeamModel& beams, const PointCloud& cloud, std::size_t i) {
    const double excess = 0.02 * (1 - std::min(1.0, double(cloud.intensities[i]) / beams.bright));
    most = std::max(most, excess);
    return excess;
  });
  EXPECT_GT(most, 0.005);
}

TEST(BeamFlaws, GrazingReturnsWalk) {
  BeamFlawOptions options;
  options.walk_incidence = 0.05;
  double most = 0;
  expect_longer(options, [&](const BeamModel&, const PointCloud& cloud, std::size_t i) {
    const Vector3d p = kPose * cloud.points[i], direction = kPose.linear() * cloud.points[i].normalized();
    const double cosine = std::abs(std::abs(p.x()) > std::abs(p.y()) ? direction.x() : direction.y());
    most = std::max(most, 0.05 * (1 - cosine));
    return 0.05 * (1 - cosine);
  });
  EXPECT_GT(most, 0.02);
}

/// The ray to the wall, turned by hand: what is reported lies along the nominal direction, as far as the true one goes.
TEST(BeamFlaws, BeamsPointAsideByTheirErrorsAndTheEncoders) {
  BeamFlawOptions options;
  options.beam_elevation = 0.3, options.beam_azimuth = 0.2, options.encoder = 0.1;
  const FlawedLidar sensor = flawed(options);
  const PointCloud ideal = seen({vlp16()}), measured = seen(sensor);
  ASSERT_EQ(measured.size(), ideal.size());
  double most = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Vector3d& p = measured.points[i];
    const std::size_t ring = measured.rings[i];
    ASSERT_LT(p.normalized().cross(ideal.points[i].normalized()).norm(), 1e-12);
    const double a = std::atan2(p.y(), p.x()), elevation = std::asin(p.z() / p.norm()) - sensor.beams.elevation[ring];
    const Eigen::Vector4d harmonics(std::cos(a), std::sin(a), std::cos(2 * a), std::sin(2 * a));
    const double azimuth = a - sensor.beams.azimuth[ring] - harmonics.dot(sensor.beams.encoder);
    const Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
    ASSERT_NEAR(off_the_walls(kPose * (p.norm() * direction)), 0, 1e-9) << i;
    most = std::max(most, std::abs(off_the_walls(kPose * p)));
  }
  EXPECT_GT(most, 0.005);
}

TEST(BeamFlaws, CorrectedScansOfAMovingSensorLieOnTheWalls) {
  NoiseOptions rolling = noiseless();
  rolling.snapshot = false;
  const std::vector<Leg> legs{{2, 2, 80 * kDegree}};
  const Trajectory way = drive(legs, upright({-2, -3, 0}, 0), {});
  BeamFlawOptions options = flaws_of(BeamPreset::worn);
  options.beam_azimuth = 0.05, options.range_scale = 0.002;
  const FlawedLidar sensor = flawed(options);
  const PointCloud measured = simulate_scan(room(), sensor, way, rolling, {1.0, 5, 0}).scan.cloud;
  const PointCloud mended = corrected(measured, sensor.beams);
  double raw = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Pose T = interpolate(way, 1.0 + double(measured.times[i]));
    ASSERT_LT(std::abs(off_the_walls(T * mended.points[i])), 1e-4) << i;
    raw = std::max(raw, std::abs(off_the_walls(T * measured.points[i])));
  }
  EXPECT_GT(raw, 0.02);
}

TEST(BeamFlaws, ComeBeforeNoiseAndSteps) {
  const LidarModel lidar = vlp16();
  const LabelledScan scan =
      simulate_scan(room(), flawed(flaws_of(BeamPreset::worn)), {{0, kPose}}, NoiseOptions{}, {0, 5, 0});
  for (const Vector3d& p : scan.scan.cloud.points) {
    const double steps = p.norm() / lidar.range_step;
    ASSERT_NEAR(steps, std::round(steps), 1e-6);
  }
}

TEST(BeamFlaws, BeginAtAPresetThatKeysOverride) {
  const BeamFlawOptions worn =
      simulation_options("corridor", {{"beams", "worn"}, {"walk", "0"}, {"beam_azimuth", "0.1"}}).flaws;
  EXPECT_EQ(worn.beam_range, 0.02);
  EXPECT_EQ(worn.beam_elevation, 0.15);
  EXPECT_EQ(worn.encoder, 0.03);
  EXPECT_EQ(worn.walk, 0);
  EXPECT_EQ(worn.beam_azimuth, 0.1);
  try {
    simulation_options("corridor", {{"beams", "broken"}});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("ideal | good | worn"), std::string::npos) << e.what();
  }
}

TEST(BeamFlaws, AreRefusedOfARosette) {
  const OptionValues values{{"sensor", "rosette"}, {"duration", "1"}, {"walk", "0.01"}};
  try {
    Simulator("corridor", simulation_options("corridor", values));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("sensor rosette"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tilth

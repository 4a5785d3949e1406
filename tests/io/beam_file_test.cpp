#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "io/expect_error.hpp"
#include "io/temporary_folder.hpp"
#include <tilth/io/beam_file.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

BeamEstimate parsed(const std::string& text) {
  return parse_beams(text, "b.yaml");
}

/// Random errors of n beams and a covariance of full rank.
BeamEstimate made(std::size_t n) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  BeamEstimate estimate;
  for (std::size_t ring = 0; ring < n; ++ring) {
    estimate.model.range.push_back(0.02 * normal(random));
    estimate.model.elevation.push_back(0.003 * normal(random));
  }
  for (double& each : estimate.model.encoder) each = 5e-4 * normal(random);
  estimate.model.range_scale = 1e-3 * normal(random);
  estimate.model.walk = 0.02 * normal(random);
  estimate.model.bright = 150;
  const auto size = Eigen::Index(parameter_count(n));
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return 1e-3 * normal(random); });
  estimate.covariance = root * root.transpose();
  estimate.covariance = 0.5 * (estimate.covariance + estimate.covariance.transpose()).eval();
  return estimate;
}

void expect_same(const BeamEstimate& a, const BeamEstimate& b) {
  EXPECT_EQ(a.model.range, b.model.range);
  EXPECT_EQ(a.model.elevation, b.model.elevation);
  EXPECT_EQ(a.model.azimuth, b.model.azimuth);
  EXPECT_EQ(a.model.encoder, b.model.encoder);
  EXPECT_EQ(a.model.range_scale, b.model.range_scale);
  EXPECT_EQ(a.model.walk, b.model.walk);
  EXPECT_EQ(a.model.bright, b.model.bright);
  ASSERT_EQ(a.covariance.rows(), b.covariance.rows());
  EXPECT_TRUE(a.covariance.size() == 0 || a.covariance == b.covariance);
}

TEST(BeamFile, ComesBackToTheLastBit) {
  const TemporaryFolder folder;
  for (const std::size_t n : {0U, 1U, 16U, 128U}) {
    BeamEstimate estimate = made(n);
    write_beams(folder / "beams.yaml", estimate);
    expect_same(read_beams(folder / "beams.yaml"), estimate);
    estimate.model.azimuth.assign(n, 1.0 / 3000), estimate.covariance.resize(0, 0);
    write_beams(folder / "beams.yaml", estimate);
    expect_same(read_beams(folder / "beams.yaml"), estimate);
  }
  write_beams(folder / "beams.yaml", {});
  expect_same(read_beams(folder / "beams.yaml"), {});
}

TEST(BeamFile, EveryAngleComesBackToTheLastBit) {
  const TemporaryFolder folder;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> angle(-5 * kDegree, 5 * kDegree);
  for (int round = 0; round < 20; ++round) {
    BeamEstimate estimate;
    for (int i = 0; i < 256; ++i) estimate.model.elevation.push_back(angle(random));
    write_beams(folder / "beams.yaml", estimate);
    expect_same(read_beams(folder / "beams.yaml"), estimate);
  }
}

TEST(BeamFile, IsReadableAndSaysWhatErrorsAre) {
  const TemporaryFolder folder;
  BeamEstimate estimate = parsed("version: 1\nrange: [0.02, -0.005]\nelevation: [0.15, 0]\n");
  estimate.covariance = 1e-6 * Eigen::MatrixXd::Identity(9, 9);
  write_beams(folder / "beams.yaml", estimate);
  const auto bytes = read_file(folder / "beams.yaml");
  const std::string text(as_text(bytes));
  for (const char* line : {"# Constant errors of a sensor's beams: what is measured minus what is true.",
                           "version: 1\n", "range: [0.02, -0.005]", "elevation: [0.15, 0]", "deviations:",
                           "  range: [0.001, 0.001]", "  elevation: [0.0573, 0.0573]", "covariance:", "bright: 255"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
}

TEST(BeamFile, WhatIsLeftOutIsZero) {
  const BeamModel model = parsed("version: 1\nelevation: [0.1, -0.1]\n").model;
  EXPECT_TRUE(model.range.empty());
  EXPECT_DOUBLE_EQ(model.elevation[1], -0.1 * kDegree);
  EXPECT_EQ(model.bright, BeamModel{}.bright);
}

TEST(BeamFile, ErrorsNameFileLineKeyAndBound) {
  const auto refused = [](const std::string& text, std::vector<std::string> parts) {
    parts.push_back("b.yaml");
    expect_error([&] { parsed("version: 1\n" + text); }, parts);
  };
  expect_error([] { parsed("range: [0]\n"); }, {"b.yaml", "version"});
  expect_error([] { parsed("version: 2\n"); }, {"b.yaml, line 1", "key version", "is not 1"});
  expect_error([] { parsed("- 1\n"); }, {"b.yaml", "no map"});
  expect_error([] { parsed(""); }, {"b.yaml", "no map"});
  refused("ranges: [0]\n", {"line 2, key ranges: is not known", "range_scale"});
  refused("walk: 0\nwalk: 0\n", {"line 3", "key walk: is given twice"});
  refused("range: [0, 0]\nelevation: [0]\n", {"line 3", "key elevation: has 1 beams, another list 2"});
  refused("range: [0, 1.5]\n", {"line 2", "key range: is 1.5, beyond 1 m"});
  refused("elevation: [0, -6]\n", {"line 2", "key elevation: is -6, beyond 5 deg"});
  refused("azimuth:\n  - 0\n  - nan\n", {"line 4", "key azimuth: is 'nan', expected a finite number"});
  refused("range: [0, inf]\n", {"key range", "finite"});
  refused("range: [a]\n", {"key range", "finite"});
  refused("range: [[0]]\n", {"key range", "finite"});
  refused("range: 3\n", {"key range", "no list"});
  refused("encoder: [0, 0, 0]\n", {"key encoder: has 3 values, expected 4"});
  refused("range_scale: 0.5\n", {"key range_scale: is 0.5, beyond 0.1"});
  refused("bright: 0\n", {"key bright: is 0, expected more than 0"});
  refused("walk: [0\n", {"no YAML"});
  std::string many = "range: [0";
  for (int i = 0; i < 256; ++i) many += ", 0";
  refused(many + "]\n", {"key range: has more than 256 beams"});
}

TEST(BeamFile, ACovarianceIsOneOfItsBeams) {
  const auto refused = [](const std::string& covariance, const std::vector<std::string>& parts) {
    expect_error([&] { parsed("version: 1\nwalk: 0\ncovariance: " + covariance + "\n"); }, parts);
  };
  const std::string unit = "[[1], [0, 1], [0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 0, 1]]";
  EXPECT_EQ(parsed("version: 1\ncovariance: " + unit + "\n").covariance, Eigen::MatrixXd::Identity(5, 5));
  refused("[[1]]", {"b.yaml, line 3", "key covariance: has 1 rows", "5 rows (0 beams)"});
  refused("3", {"key covariance: has 0 rows"});
  refused("[[1], [0], [0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 0, 1]]", {"key covariance: has 1 values in a row"});
  refused("[[1], [2, 1], [0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 0, 1]]", {"is not positive semidefinite"});
  refused("[[1], [0, -1e-9], [0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 0, 1]]", {"is not positive semidefinite"});
  refused("[[1], [0.1, 0], [0, 0, 1], [0, 0, 0, 1], [0, 0, 0, 0, 1]]", {"is not positive semidefinite"});
  refused("[[1], [0.9, 1], [-0.9, 0.9, 1], [0, 0, 0, 1], [0, 0, 0, 0, 1]]", {"is not positive semidefinite"});
}

TEST(BeamFile, CorruptionNeverCrashes) {
  const TemporaryFolder folder;
  write_beams(folder / "beams.yaml", made(2));
  expect_corruption_survived(read_file(folder / "beams.yaml"), 2000, [](const auto& bytes) {
    parsed({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  });
}

}  // namespace
}  // namespace tilth

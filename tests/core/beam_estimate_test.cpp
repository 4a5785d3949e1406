#include <gtest/gtest.h>

#include <tilth/core/beam_estimate.hpp>

namespace tilth {
namespace {

TEST(BeamEstimate, ParametersComeBackIntoTheModel) {
  BeamModel model;
  model.range = {0.01, -0.02, 0.03}, model.azimuth = {1e-3, 2e-3, 3e-3};
  model.encoder = {1e-4, 2e-4, 3e-4, 4e-4}, model.walk = 0.02, model.range_scale = 1e-3;
  const Eigen::VectorXd theta = parameters_of(model, 3);
  Eigen::VectorXd expected(11);
  expected << 0.01, -0.02, 0.03, 0, 0, 0, 0.02, 1e-4, 2e-4, 3e-4, 4e-4;
  EXPECT_EQ(theta, expected);
  const BeamModel back = with_parameters(model, 2 * theta);
  EXPECT_EQ(back.range, (std::vector<double>{0.02, -0.04, 0.06}));
  EXPECT_EQ(back.elevation, std::vector<double>(3, 0.0));
  EXPECT_EQ(back.azimuth, model.azimuth);
  EXPECT_EQ(back.range_scale, model.range_scale);
  EXPECT_EQ(parameters_of(back, 3), 2 * theta);
}

TEST(BeamEstimate, CovariancesAreToldByTheirEigenvaluesWhateverTheirUnits) {
  Eigen::Matrix2d covariance;
  covariance << 1e-4, 0.99e-8, 0.99e-8, 1e-12;
  EXPECT_TRUE(positive_semidefinite(covariance));
  covariance(0, 1) = covariance(1, 0) = 1.01e-8;
  EXPECT_FALSE(positive_semidefinite(covariance));
  EXPECT_TRUE(positive_semidefinite(Eigen::MatrixXd::Zero(3, 3)));
  EXPECT_TRUE(positive_semidefinite(Eigen::MatrixXd()));
}

}  // namespace
}  // namespace tilth

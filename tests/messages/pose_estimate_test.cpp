// A pose with its covariance comes back as it was written, in both serialisations; what is cut or no motion is refused.
#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/messages/pose_estimate.hpp>

namespace tilth {
namespace {

const Pose kTurned(Eigen::Translation3d(0.3, -1, 2) *
                   Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));

/// 1 .. 6 on its diagonal: rotations [rad^2] about x, y, z of the body, then translations [m^2] along them.
Matrix6d ascending() {
  return Matrix6d(Eigen::Matrix<double, 6, 1>(1, 2, 3, 4, 5, 6).asDiagonal());
}

TEST(PoseEstimate, ComesBackAsItWasWritten) {
  for (const Serialization serialization : {Serialization::ros1, Serialization::cdr}) {
    const std::vector<std::byte> message = serialize_pose_estimate({1.5, kTurned}, ascending(), "map", serialization);
    const PoseGuess guess = parse_pose_guess(message, serialization);
    EXPECT_EQ(guess.world, "map");
    EXPECT_TRUE(guess.T_world_body.isApprox(kTurned, 1e-14));
    RosMessageReader reader(message, serialization, "PoseWithCovarianceStamped");
    EXPECT_EQ(reader.header().stamp, 1.5);
    Eigen::Matrix<double, 7, 1> pose;
    for (double& value : pose) value = std::bit_cast<double>(reader.number<std::uint64_t>("pose"));
    Matrix6d in_world;
    for (double& value : in_world.reshaped()) value = std::bit_cast<double>(reader.number<std::uint64_t>("covariance"));
    EXPECT_EQ(reader.left(), 0U);
    const Matrix6d expected = Eigen::Matrix<double, 6, 1>(5, 4, 6, 2, 1, 3).asDiagonal();
    EXPECT_TRUE(in_world.isApprox(expected, 1e-12)) << "a quarter turn swaps x and y; translation stands first";
  }
}

TEST(PoseEstimate, IsRefusedWhereItIsCutOrNoMotion) {
  const std::vector<std::byte> whole = serialize_pose_estimate({1.5, kTurned}, ascending(), "map");
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(parse_pose_guess(std::span(whole).first(length), Serialization::cdr), Error) << length;
  std::vector<std::byte> none = serialize_pose_estimate({1.5, kTurned}, ascending(), "map", Serialization::ros1);
  std::fill(none.end() - 320, none.end() - 288, std::byte(0));
  EXPECT_THROW(parse_pose_guess(none, Serialization::ros1), Error) << "a rotation of nothing";
}

}  // namespace
}  // namespace tilth

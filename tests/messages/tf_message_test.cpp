// Transforms come back as they were written, in both serialisations; what is cut or no motion is refused.
#include <limits>

#include <gtest/gtest.h>

#include <tilth/core/error.hpp>
#include <tilth/messages/tf_message.hpp>

namespace tilth {
namespace {

std::vector<StampedTransform> two_transforms() {
  const Pose turned(Eigen::Translation3d(0.3, -1, 2) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()));
  return {{1.5, {"base_link", "mast"}, turned}, {2.25, {"mast", "lidar"}, turned.inverse()}};
}

TEST(TfMessage, ComesBackAsItWasWritten) {
  const std::vector<StampedTransform> written = two_transforms();
  for (const Serialization serialization : {Serialization::ros1, Serialization::cdr}) {
    const std::vector<StampedTransform> read = parse_tf(serialize_tf(written, serialization), serialization);
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].stamp, written[i].stamp);
      EXPECT_EQ(read[i].frames.world, written[i].frames.world);
      EXPECT_EQ(read[i].frames.body, written[i].frames.body);
      EXPECT_TRUE(read[i].T_world_body.isApprox(written[i].T_world_body, 1e-14));
    }
  }
}

TEST(TfMessage, RefusesWhatIsCutAtEveryLength) {
  const std::vector<std::byte> whole = serialize_tf(two_transforms());
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(parse_tf(std::span(whole).first(length), Serialization::cdr), Error) << length;
}

TEST(TfMessage, RefusesWhatIsNoMotion) {
  std::vector<StampedTransform> transforms = two_transforms();
  transforms[1].T_world_body.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(parse_tf(serialize_tf(transforms), Serialization::cdr), Error);
  std::vector<std::byte> zeros = serialize_tf(std::vector<StampedTransform>{{0.0, {"a", "b"}}}, Serialization::ros1);
  std::fill(zeros.end() - 32, zeros.end(), std::byte(0));
  EXPECT_THROW(parse_tf(zeros, Serialization::ros1), Error) << "a rotation of nothing";
}

}  // namespace
}  // namespace tilth

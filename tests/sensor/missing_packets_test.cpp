// Packets lost on the way, and those that a cropped view never sends.
#include <cmath>

#include <gtest/gtest.h>

#include <tilth/sensor/missing_packets.hpp>

namespace tilth {
namespace {

TEST(MissingPackets, OfACroppedViewAreNotLost) {
  MissingPackets missing;
  for (int turn = 0; turn < 20; ++turn) missing.add(std::fmod(35900.0 + 37.0 * (turn % 5), 36000.0), 50 + turn % 3);
  EXPECT_EQ(missing.lost(), 0U);
  EXPECT_EQ(missing.unsent(), 20U * 50 + 19);
}

TEST(MissingPackets, HereAndThereAreLost) {
  MissingPackets missing;
  for (int i = 0; i < 20; ++i) missing.add(std::fmod(i * 7919.0, 36000.0), 12);
  missing.add(100.0, 300);
  missing.add(110.0, 20);
  missing.add(115.0, 1), missing.add(115.0, 1);
  EXPECT_EQ(missing.lost(), 20U * 12 + 322);
  EXPECT_EQ(missing.unsent(), 0U);
}

TEST(MissingPackets, LossesWithinACroppedViewAreCountedApart) {
  MissingPackets missing;
  for (int turn = 0; turn < 10; ++turn) {
    missing.add(18000.0, 30);
    if (turn == 5) missing.add(9000.0, 7), missing.add(18000.0, 30);
  }
  EXPECT_GE(missing.lost(), 7U);
  EXPECT_LE(missing.lost(), 7U + 30U);
  EXPECT_EQ(missing.lost() + missing.unsent(), 11U * 30 + 7);
}

}  // namespace
}  // namespace tilth

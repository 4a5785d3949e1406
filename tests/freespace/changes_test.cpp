// Points that changed, put together to things.
#include <gtest/gtest.h>

#include <tilth/freespace/changes.hpp>

namespace tilth {
namespace {

/// A box of points 10 cm apart.
void add_box(std::vector<ChangedPoint>& points, const Eigen::Vector3f& corner, const Eigen::Vector3f& size,
             const Stay& stay) {
  for (float x = 0; x <= size.x(); x += 0.1F) {
    for (float y = 0; y <= size.y(); y += 0.1F) {
      for (float z = 0; z <= size.z(); z += 0.1F) points.push_back({corner + Eigen::Vector3f(x, y, z), stay});
    }
  }
}

const Stay kLeft{ChangeKind::left, 1, 9, 0}, kCame{ChangeKind::came, 4, 30, 3.5};

TEST(Changes, ThingsThatLieApartAreTwo) {
  std::vector<ChangedPoint> points;
  add_box(points, {0, 0, 0}, {1.05F, 0.55F, 0.55F}, kLeft);
  add_box(points, {5, 0, 0}, {0.55F, 0.55F, 0.55F}, {ChangeKind::left, 2, 5, 0});
  const std::vector<Change> changes = changes_of(points);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_DOUBLE_EQ(changes[0].stay.last_seen, 5);  // in the order in which they left
  EXPECT_TRUE(changes[1].box.center().isApprox(Eigen::Vector3f(0.5F, 0.25F, 0.25F), 1e-3F));
  EXPECT_TRUE(changes[1].box.sizes().isApprox(Eigen::Vector3f(1.0F, 0.5F, 0.5F), 1e-3F));
  EXPECT_EQ(changes[0].points + changes[1].points, points.size());
}

TEST(Changes, WhatLeavesAndWhatComesToItsPlaceAreTwo) {
  std::vector<ChangedPoint> points;
  add_box(points, {0, 0, 0}, {0.5F, 0.5F, 0.5F}, kLeft);
  add_box(points, {0.05F, 0, 0}, {0.5F, 0.5F, 0.5F}, kCame);
  add_box(points, {0, 0.05F, 0}, {0.5F, 0.5F, 0.5F}, {ChangeKind::left, 20, 28, 0});  // another one, later
  const std::vector<Change> changes = changes_of(points);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(name_of(changes[0].stay.kind), "came");
  EXPECT_EQ(name_of(changes[1].stay.kind), "left");
  EXPECT_DOUBLE_EQ(changes[2].stay.first_seen, 20);
}

TEST(Changes, AThingIsSeenFromItsFirstPointToItsLast) {
  std::vector<ChangedPoint> points;
  add_box(points, {0, 0, 0}, {0.5F, 0.5F, 0.5F}, {ChangeKind::left, 3, 9, 0});
  add_box(points, {0.6F, 0, 0}, {0.5F, 0.5F, 0.5F}, {ChangeKind::left, 5, 12, 0});
  const std::vector<Change> changes = changes_of(points);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_DOUBLE_EQ(changes[0].stay.first_seen, 3);
  EXPECT_DOUBLE_EQ(changes[0].stay.last_seen, 12);
}

TEST(Changes, WhatComesBitByBitIsSeenLateAndDoesNotCome) {
  std::vector<ChangedPoint> at_once, bit_by_bit;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3f corner(0.1F * float(i), 0, 0);
    add_box(at_once, corner, {0.05F, 0.55F, 0.55F}, {ChangeKind::came, 10.0 + i, 30, 9.5});
    add_box(bit_by_bit, corner, {0.05F, 0.55F, 0.55F}, {ChangeKind::came, 10.0 + i, 30, 9.5 + i});
  }
  EXPECT_EQ(changes_of(at_once).size(), 1U);
  EXPECT_TRUE(changes_of(bit_by_bit).empty());
}

TEST(Changes, StrayPointsAreNone) {
  std::vector<ChangedPoint> points;
  for (int i = 0; i < 200; ++i) points.push_back({{float(i), 0, 0}, kLeft});
  add_box(points, {0, 5, 0}, {0.2F, 0.1F, 0.1F}, kLeft);
  EXPECT_TRUE(changes_of(points).empty());
  EXPECT_TRUE(changes_of({}).empty());
}

}  // namespace
}  // namespace tilth

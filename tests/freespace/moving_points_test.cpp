// A room of bare walls with a board that comes and goes, seen from its middle: what beams say of it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr float kHalfRoom = 5.02F, kBoard = 2.53F, kBoardWidth = 0.6F;

/// Beams over a full turn at several heights; the board stands before the wall at x = kHalfRoom, where `board`.
SeenScan scan_of_room(std::size_t number, bool board) {
  const Eigen::Vector3f origin(0, 0, 1);
  SeenScan scan{0.1 * double(number), {}, {origin}, {}};
  for (int column = 0; column < 1440; ++column) {
    const float angle = float(column) * float(std::numbers::pi) / 720;
    const Eigen::Vector2f along(std::cos(angle), std::sin(angle));
    for (int ring = -6; ring <= 6; ++ring) {
      float range = kHalfRoom / along.cwiseAbs().maxCoeff();
      if (board && along.x() > 0 && std::abs(along.y() / along.x() * kBoard) < kBoardWidth / 2)
        range = kBoard / along.x();
      scan.points.push_back(origin + range * Eigen::Vector3f(along.x(), along.y(), 0.03F * float(ring)));
    }
  }
  scan.origin_of.assign(scan.points.size(), 0);
  return scan;
}

bool on_board(const Eigen::Vector3f& p) {
  return std::abs(p.x() - kBoard) < 1e-3F && std::abs(p.y()) < kBoardWidth / 2;
}

/// A drive whose every point is watched, and of each point the thing and whether it is one of the board.
struct Watch {
  MovingPoints moving{MovingOptions{}};
  std::vector<std::uint32_t> board, walls;

  void add(std::size_t number, bool with_board) {
    const SeenScan scan = scan_of_room(number, with_board);
    const std::vector<std::uint32_t> things = moving.add(scan, scan.points);
    for (std::size_t i = 0; i < things.size(); ++i) (on_board(scan.points[i]) ? board : walls).push_back(things[i]);
  }

  double share_moved(const std::vector<std::uint32_t>& things) const {
    const auto moved = std::count_if(things.begin(), things.end(), [&](auto thing) { return moving.moved(thing); });
    return double(moved) / std::max<double>(1.0, double(things.size()));
  }
};

/// `scans` scans with the board in those from `from` to `to`, judged.
Watch seen(std::size_t scans, std::size_t from, std::size_t to) {
  Watch watch;
  for (std::size_t i = 1; i <= scans; ++i) watch.add(i, i >= from && i <= to);
  watch.moving.judge(Eigen::Vector3f::Zero(), 0);
  return watch;
}

void expect_moved(const Watch& watch) {
  EXPECT_GT(watch.share_moved(watch.board), 0.98);
  EXPECT_LT(watch.share_moved(watch.walls), 0.001);
}

TEST(MovingPoints, WallsStand) {
  const Watch watch = seen(40, 1, 0);
  EXPECT_EQ(watch.share_moved(watch.walls), 0.0);
}

TEST(MovingPoints, WhatLeftHasMoved) {
  expect_moved(seen(120, 1, 10));
}

TEST(MovingPoints, WhatWasFreeBeforeAndIsSeenForAMomentHasMoved) {
  expect_moved(seen(70, 61, 70));
}

TEST(MovingPoints, WhatCameAndStaysStands) {
  const Watch watch = seen(130, 61, 130);
  EXPECT_LT(watch.share_moved(watch.board), 0.02);
  EXPECT_LT(watch.share_moved(watch.walls), 0.001);
}

TEST(MovingPoints, WhatIsSeenWhereSomethingHasGoneIsAnotherThing) {
  Watch watch = seen(100, 1, 10);
  const std::vector<std::uint32_t> first = std::exchange(watch.board, {});
  EXPECT_TRUE(std::all_of(first.begin(), first.end(), [&](auto thing) { return watch.moving.gone(thing); }));
  for (std::size_t i = 101; i <= 160; ++i) watch.add(i, true);
  watch.moving.judge(Eigen::Vector3f::Zero(), 0);
  EXPECT_GT(watch.share_moved(first), 0.98);
  EXPECT_LT(watch.share_moved(watch.board), 0.02);
}

/// Kind and times of what changed; of each thing of the board the same.
void expect_change(const Watch& watch, ChangeKind kind, double first, double last) {
  std::size_t told = 0;
  for (const std::uint32_t thing : watch.board) {
    const std::optional<Stay> stay = watch.moving.changed(thing);
    if (!stay) continue;
    ++told;
    EXPECT_EQ(stay->kind, kind);
    EXPECT_NEAR(stay->first_seen, first, 0.5);
    EXPECT_NEAR(stay->last_seen, last, 0.9);  // what is calm is looked at in every 8th scan
  }
  EXPECT_GT(double(told), 0.95 * double(watch.board.size()));
  for (const std::uint32_t thing : watch.walls) EXPECT_FALSE(watch.moving.changed(thing).has_value());
}

TEST(MovingPoints, TellWhatStoodAndLeft) {
  expect_change(seen(140, 1, 70), ChangeKind::left, 0.1, 7.0);
}

TEST(MovingPoints, TellWhatCameAndStays) {
  expect_change(seen(150, 61, 150), ChangeKind::came, 6.1, 15.0);
}

TEST(MovingPoints, TellNothingOfWhatOnlyPassedBy) {
  const Watch watch = seen(120, 31, 60);
  EXPECT_TRUE(std::none_of(watch.board.begin(), watch.board.end(),
                           [&](std::uint32_t thing) { return watch.moving.changed(thing).has_value(); }));
}

TEST(MovingPoints, ForgetsWhatWasJudgedAndNumbersTheRestAnew) {
  Watch watch = seen(60, 1, 10);
  const std::size_t before = watch.moving.bytes();
  watch.moving.judge(Eigen::Vector3f::Zero(), 100);
  const std::vector<std::uint32_t> same = watch.moving.forget(Eigen::Vector3f::Zero(), 100);
  for (std::uint32_t i = 0; i < same.size(); ++i) ASSERT_EQ(same[i], i);
  EXPECT_EQ(watch.moving.bytes(), before);
  EXPECT_GT(watch.share_moved(watch.board), 0.9);
  watch.moving.judge(Eigen::Vector3f::Zero(), 0);
  const std::vector<std::uint32_t> none = watch.moving.forget(Eigen::Vector3f::Zero(), 0);
  EXPECT_EQ(std::count(none.begin(), none.end(), MovingPoints::kNone), std::ssize(none));
  EXPECT_EQ(watch.moving.bytes(), 0U);
  for (std::size_t i = 61; i <= 90; ++i) watch.add(i, false);
  EXPECT_GT(watch.moving.bytes(), 0U);
}

TEST(MovingPoints, WhatIsFarAndWasNeverNearerIsNotJudgedYet) {
  Watch watch;
  for (std::size_t i = 1; i <= 40; ++i) watch.add(i, false);
  watch.moving.judge({0, 0, 1}, 3);
  EXPECT_FALSE(watch.moving.judged(watch.walls.front()));
  watch.moving.judge({100, 0, 1}, 45);
  EXPECT_TRUE(watch.moving.judged(watch.walls.front()));
}

TEST(MovingPoints, PassesOverWhatIsNotFinite) {
  MovingPoints moving(MovingOptions{});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  SeenScan scan{0.0, {}, {Eigen::Vector3f::Zero()}, {}};
  for (const float bad : {kNan, kInfinity, -kInfinity, 1e30F}) {
    for (int i = 0; i < 30; ++i) scan.points.emplace_back(0.0F, bad, 1.0F);
  }
  scan.origin_of.assign(scan.points.size(), 0);
  for (int i = 0; i < 50; ++i) {
    for (const std::uint32_t thing : moving.add(scan, scan.points)) EXPECT_EQ(thing, MovingPoints::kNone);
  }
  moving.judge(Eigen::Vector3f::Zero(), 0);
  EXPECT_FALSE(moving.moved(MovingPoints::kNone));
}

}  // namespace
}  // namespace tilth

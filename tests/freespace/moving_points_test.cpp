// A room of bare walls with a board that comes and goes, seen from its middle: what beams say of it.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <tilth/freespace/moving_points.hpp>

namespace tilth {
namespace {

constexpr float kHalfRoom = 5.02F, kBoard = 2.53F, kBoardWidth = 0.6F;

/// Beams over a full turn at several heights; the board stands before the wall at x = kHalfRoom, where `board`.
SeenScan scan_of_room(std::size_t number, bool board) {
  const std::size_t every = MovingOptions{}.every;
  SeenScan scan{0.1 * double(number), {}, {}};
  const Eigen::Vector3f origin(0, 0, 1);
  std::size_t beam = 0;
  for (int column = 0; column < 1440; ++column) {
    const float angle = float(column) * float(std::numbers::pi) / 720;
    const Eigen::Vector2f along(std::cos(angle), std::sin(angle));
    for (int ring = -6; ring <= 6; ++ring, ++beam) {
      float range = kHalfRoom / along.cwiseAbs().maxCoeff();
      if (board && along.x() > 0 && std::abs(along.y() / along.x() * kBoard) < kBoardWidth / 2)
        range = kBoard / along.x();
      const Eigen::Vector3f p = origin + range * Eigen::Vector3f(along.x(), along.y(), 0.03F * float(ring));
      scan.points.push_back(p);
      if (beam % every == number % every) scan.lines.push_back({origin, p});
    }
  }
  return scan;
}

bool on_board(const Eigen::Vector3f& p) {
  return std::abs(p.x() - kBoard) < 1e-3F && std::abs(p.y()) < kBoardWidth / 2;
}

struct Shares {
  double board = 0, walls = 0;  ///< that moved
};

/// Of the points of `scan`, which was the `number`-th.
Shares moved_of(const MovingPoints& moving, const SeenScan& scan, std::uint32_t number) {
  double board = 0, walls = 0, board_moved = 0, walls_moved = 0;
  for (const Eigen::Vector3f& p : scan.points) {
    const double moved = moving.moved(p, number) ? 1 : 0;
    (on_board(p) ? board : walls) += 1;
    (on_board(p) ? board_moved : walls_moved) += moved;
  }
  return {board > 0 ? board_moved / board : 0, walls_moved / walls};
}

/// `scans` scans with the board in those from `from` to `to`.
MovingPoints seen(std::size_t scans, std::size_t from, std::size_t to) {
  MovingPoints moving(MovingOptions{});
  for (std::size_t i = 1; i <= scans; ++i) moving.add(scan_of_room(i, i >= from && i <= to));
  moving.judge(Eigen::Vector3f::Zero(), 0);
  return moving;
}

TEST(MovingPoints, WallsStand) {
  EXPECT_EQ(moved_of(seen(40, 1, 0), scan_of_room(40, false), 40).walls, 0.0);
}

TEST(MovingPoints, WhatLeftHasMoved) {
  const Shares shares = moved_of(seen(120, 1, 10), scan_of_room(5, true), 5);
  EXPECT_GT(shares.board, 0.98);
  EXPECT_LT(shares.walls, 0.001);
}

TEST(MovingPoints, WhatWasFreeBeforeAndIsSeenForAMomentHasMoved) {
  const Shares shares = moved_of(seen(70, 61, 70), scan_of_room(65, true), 65);
  EXPECT_GT(shares.board, 0.98);
  EXPECT_LT(shares.walls, 0.001);
}

TEST(MovingPoints, WhatCameAndStaysStands) {
  const Shares shares = moved_of(seen(130, 61, 130), scan_of_room(100, true), 100);
  EXPECT_LT(shares.board, 0.02);
  EXPECT_LT(shares.walls, 0.001);
}

TEST(MovingPoints, SaysWhichPointsAreTheFirstWhereSomethingElseHasGone) {
  MovingPoints moving(MovingOptions{});
  std::size_t anew = 0;
  for (std::size_t i = 1; i <= 101; ++i) {
    const std::vector<std::uint8_t> flags = moving.add(scan_of_room(i, i <= 10 || i == 101));
    for (const std::uint8_t flag : flags) anew += i == 101 ? flag : 0;
    if (i == 101) continue;
    EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 0) << i;
  }
  EXPECT_GT(anew, 10U);
}

TEST(MovingPoints, ForgetsWhatIsFarAndKnowsNothingOfItThen) {
  MovingPoints moving = seen(60, 1, 10);
  const std::size_t before = moving.bytes();
  moving.forget(Eigen::Vector3f::Zero(), 100);
  EXPECT_EQ(moving.bytes(), before);
  EXPECT_GT(moved_of(moving, scan_of_room(5, true), 5).board, 0.9);
  moving.forget(Eigen::Vector3f::Zero(), 0);
  EXPECT_EQ(moving.bytes(), 0U);
  EXPECT_FALSE(moving.moved({kBoard, 0, 1}, 5));
  moving.add(scan_of_room(61, false));
  EXPECT_GT(moving.bytes(), 0U);
}

TEST(MovingPoints, PassesOverWhatIsNotFinite) {
  MovingPoints moving(MovingOptions{});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  SeenScan scan;
  for (const float bad : {kNan, kInfinity, -kInfinity, 1e30F}) {
    scan.points.emplace_back(bad, 0.0F, 0.0F);
    scan.lines.push_back({{0, 0, 0}, {0, bad, 0}});
    scan.lines.push_back({{bad, 0, 0}, {1, 1, 1}});
  }
  moving.add(scan);
  EXPECT_FALSE(moving.moved({kNan, 0, 0}, 1));
  EXPECT_EQ(moving.bytes(), 0U);
}

}  // namespace
}  // namespace tilth

// What a scan says of places, held against every beam followed one by one.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <tilth/freespace/scan_view.hpp>

namespace tilth {
namespace {

/// Beams in all directions of up to 20 degrees from level, from a sensor that moves on meanwhile.
SeenScan scan_at_random(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> range(2, 25), slope(-0.35F, 0.35F);
  SeenScan scan;
  for (int i = 0; i < 64; ++i) scan.origins.emplace_back(3.0F + 0.002F * float(i), -2.0F, 1.0F);
  for (int i = 0; i < 20000; ++i) {
    const float angle = float(i) / 20000 * 2 * float(std::numbers::pi);
    const Eigen::Vector3f direction = Eigen::Vector3f(std::cos(angle), std::sin(angle), slope(random)).normalized();
    scan.origin_of.push_back(std::uint8_t(i * 64 / 20000));
    scan.points.push_back(scan.origins[scan.origin_of.back()] + range(random) * direction);
  }
  return scan;
}

/// The same, with bounds that are so much wider.
Glimpse::Kind seen_by_all_beams(const SeenScan& scan, const Eigen::Vector3f& place, const MovingOptions& options,
                                float wider) {
  bool passed = false;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f& origin = scan.origins[scan.origin_of[i]];
    const float length = (scan.points[i] - origin).norm();
    const Eigen::Vector3f direction = (scan.points[i] - origin) / length;
    const float along = (place - origin).dot(direction), miss = (place - origin - along * direction).norm();
    if (along < 0 || miss > float(options.beam_radius) + wider) continue;
    if (std::abs(length - along) < float(options.met) + wider) return Glimpse::Kind::met;
    passed |= length - along > float(options.margin) - wider;
  }
  return passed ? Glimpse::Kind::passed : Glimpse::Kind::nothing;
}

TEST(ScanView, SaysWhatEveryBeamTogetherSays) {
  const MovingOptions options;
  const SeenScan scan = scan_at_random(3);
  ScanView view;
  ViewWorkspace workspace;
  view.take(scan, options, workspace);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> within(-14, 14), height(0, 2);
  std::array<std::size_t, 3> kinds{};
  for (std::size_t i = 0; i < 3000; ++i) {
    Eigen::Vector3f place(within(random), within(random), height(random));
    if (i % 2 == 0) place = scan.points[i] + 0.03F * place.normalized();
    if ((place - view.place()).norm() < 9) continue;  // fewer beams are looked at there
    Glimpse seen;
    view.look({&place, 1}, {&seen, 1});
    const Glimpse::Kind inner = seen_by_all_beams(scan, place, options, -0.006F);
    const Glimpse::Kind outer = seen_by_all_beams(scan, place, options, 0.006F);
    if (inner == outer) {
      EXPECT_EQ(seen.kind, inner) << i << " " << place.transpose();
    }
    ++kinds[std::size_t(seen.kind)];
  }
  for (const std::size_t count : kinds) EXPECT_GT(count, 30U);
}

TEST(ScanView, SaysNothingOfWhatIsBeyondItsReachOrWithoutBeams) {
  ScanView view;
  ViewWorkspace workspace;
  SeenScan empty{0.0, {}, {Eigen::Vector3f::Zero()}, {}};
  const std::array<Eigen::Vector3f, 3> places{Eigen::Vector3f(5, 0, 0), {0, 0, 0}, {1e4F, 0, 0}};
  std::array<Glimpse, 3> seen;
  view.take(empty, MovingOptions{}, workspace);
  view.look(places, seen);
  for (const Glimpse& glimpse : seen) EXPECT_EQ(glimpse.kind, Glimpse::Kind::nothing);
}

TEST(ScanView, ThinsScansThatHaveMoreBeamsThanItKeeps) {
  ScanView thin, full;
  ViewWorkspace workspace;
  const SeenScan scan = scan_at_random(3);
  full.take(scan, MovingOptions{}, workspace);
  thin.take(scan, MovingOptions{.most_beams = 5000}, workspace);
  EXPECT_LT(thin.bytes() - sizeof(ScanView), full.bytes() / 2);
}

}  // namespace
}  // namespace tilth

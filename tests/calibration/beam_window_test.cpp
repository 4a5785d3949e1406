#include <array>
#include <calibration/flawed_drive.hpp>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <tilth/calibration/beam_window.hpp>

namespace tilth {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBeams = Index(kDriveBeams), kParameters = 2 * kBeams + 5;
constexpr Index kPoses = 36;

/// All unknowns of a window in one dense system: beams, poses, three of each plane.
struct WholeSystem {
  MatrixXd H;
  VectorXd g;
};

VectorXd derivatives(const SurfaceRow& row, Index unknowns) {
  VectorXd J = VectorXd::Zero(unknowns);
  J[row.ring] = -row.by_range, J[kBeams + row.ring] = -row.by_elevation, J[2 * kBeams] = -row.by_walk;
  J.segment<4>(kParameters - 4) = -row.by_encoder;
  J.segment<6>(kParameters + 6 * row.keyframe) = row.by_pose;
  J.segment<3>(kParameters + kPoses + 3 * row.cell) = -place_in_cell(row);
  return J;
}

WholeSystem whole_system(const WeightedRows& w) {
  const Index planes = 3 * Index(w.begin.size() - 1), n = kParameters + kPoses + planes;
  WholeSystem s{MatrixXd::Zero(n, n), VectorXd::Zero(n)};
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const VectorXd J = derivatives(w.rows[i], n);
    s.H += w.weight[Index(i)] * J * J.transpose();
    s.g += w.weight[Index(i)] * w.rows[i].distance * J;
  }
  for (Index c = kParameters + kPoses; c < n; c += 3) s.H.diagonal().segment<3>(c) += Eigen::Vector3d(1e-5, 10, 10);
  const double turn = 3 * std::numbers::pi / 180, shift = 0.3;
  for (Index k = kParameters; k < kParameters + kPoses; k += 6) {
    s.H.diagonal().segment<3>(k).array() += k == kParameters ? 1e10 : 1 / (turn * turn);
    s.H.diagonal().segment<3>(k + 3).array() += k == kParameters ? 1e10 : 1 / (shift * shift);
  }
  return s;
}

TEST(BeamWindow, EliminationIsWhatTheWholeSystemSays) {
  const auto windows = windows_of({worn_beams(1), 0.01, 1}, 1);
  SurfaceRows rows = surface_rows(windows[0], ideal_beams(), {});
  std::erase_if(rows.rows, [](const SurfaceRow& row) { return row.cell >= 40; });  // as many as a dense system bears
  const WeightedRows w = weighted_rows(rows, {});
  const WholeSystem s = whole_system(w);
  const Index rest = s.H.rows() - kParameters;
  const auto solver = s.H.bottomRightCorner(rest, rest).ldlt();
  const MatrixXd beside = s.H.bottomLeftCorner(rest, kParameters);
  const MatrixXd information = s.H.topLeftCorner(kParameters, kParameters) - beside.transpose() * solver.solve(beside);
  const VectorXd gradient = s.g.head(kParameters) - beside.transpose() * solver.solve(s.g.tail(rest));
  const BeamWindow window = eliminate(w, kDriveBeams, windows[0].size());
  EXPECT_GT(window.rows, 1000U);
  EXPECT_LT((window.information - information).norm(), 1e-6 * information.norm());
  EXPECT_LT((window.gradient - gradient).norm(), 1e-6 * s.g.head(kParameters).norm());
}

TEST(BeamWindow, TruePosesStayWhereTheyAre) {
  auto windows = windows_of({worn_beams(2), 0.0, 1}, 1);
  const Pose before = windows[0][3].T_map_lidar;
  const BeamWindow window = beam_window(windows[0], worn_beams(2), kDriveBeams, {});
  follow(windows[0], window, VectorXd::Zero(kParameters));
  EXPECT_LT(log(before.inverse() * windows[0][3].T_map_lidar).norm(), 1e-3);
}

TEST(BeamWindow, WithoutASurfaceNothingIsSaid) {
  const BeamWindow window = beam_window(std::vector<BeamKeyframe>(6), ideal_beams(), kDriveBeams, {});
  EXPECT_EQ(window.rows, 0U);
  EXPECT_TRUE(window.information.isZero(0));
}

/// Of the distance by the j-th parameter, but for its sign.
double derivative(const SurfaceRow& row, Index j) {
  return -derivatives(row, kParameters + kPoses + 3 * (Index(row.cell) + 1))[j];
}

TEST(SurfaceRows, DistancesChangeAsTheirDerivativesSay) {
  const auto windows = windows_of({ideal_beams(), 0.005, 1}, 1);
  const BeamCalibrationOptions exact{.doubt = 0};
  const SurfaceRows at = surface_rows(windows[0], ideal_beams(), exact);
  for (const Index j : {Index(2), kBeams + 1, 2 * kBeams, kParameters - 4, kParameters - 1}) {
    VectorXd theta = VectorXd::Zero(kParameters);
    theta[j] = 1e-5;
    const SurfaceRows moved = surface_rows(windows[0], with_parameters(ideal_beams(), theta), exact);
    ASSERT_EQ(moved.rows.size(), at.rows.size()) << j;
    WeightedRows expected = weighted_rows(at, exact), found = weighted_rows(moved, exact);
    for (SurfaceRow& row : expected.rows) row.distance -= theta[j] * derivative(row, j);
    expected.weight.setOnes(), found.weight.setOnes();
    fit_planes(expected), fit_planes(found);
    WeightedRows before = weighted_rows(at, exact);
    before.weight.setOnes();
    fit_planes(before);
    // A few cells have lost a point to the one beside: their changes are clipped.
    const Eigen::ArrayXd said = expected.residual - before.residual, seen = found.residual - before.residual;
    const double most = 3 * std::sqrt(said.square().mean());
    const Eigen::ArrayXd clipped = seen.max(-most).min(most), alike = said.max(-most).min(most);
    EXPECT_NEAR((clipped * alike).sum() / alike.square().sum(), 1, 0.1) << j;
    EXPECT_GT((clipped * alike).sum(), 0.9 * std::sqrt(clipped.square().sum() * alike.square().sum())) << j;
  }
}

TEST(BeamKeyframe, ReturnsAreChosenFromEveryRing) {
  PointCloud cloud;
  for (int i = 0; i < 16000; ++i) {
    cloud.points.emplace_back(5, 0.001 * i, 0);
    cloud.rings.push_back(std::uint16_t(i % 16));
  }
  std::array<int, 16> of_ring{};
  for (const BeamReturn& r : choose_returns(cloud, {.most = 800})) ++of_ring[r.ring];
  for (const int count : of_ring) EXPECT_EQ(count, 50);
}

TEST(BeamKeyframe, MeansLieOnTheSurfaceOfTheirReturns) {
  PointCloud cloud;
  for (int i = 0; i < 100; ++i) {  // a wall 4 m ahead, and beside it one 6 m ahead
    cloud.points.emplace_back(i < 50 ? 4 : 6, 0.02 * (i - 50), 0.5);
    cloud.rings.push_back(0);
  }
  int returns = 0;
  const std::vector<BeamReturn> means = choose_returns(cloud, {.most = 100});
  for (const BeamReturn& r : means) {
    returns += r.count;
    EXPECT_NEAR(r.point.x(), r.point.x() < 5 ? 4 : 6, 1e-5);
  }
  EXPECT_EQ(returns, 100);
  EXPECT_LT(means.size(), 20U);
}

}  // namespace
}  // namespace tilth

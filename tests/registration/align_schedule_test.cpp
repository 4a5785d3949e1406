// Inner steps, held directions, and the solver against Ceres on lines and planes.
#include <ceres/ceres.h>
#include <random>

#include <gtest/gtest.h>

#include <tilth/registration/align.hpp>

namespace tilth {
namespace {

const Pose kTruth = exp((Vector6d() << 0.05, -0.04, 0.3, 0.5, -0.2, 0.1).finished());
constexpr double kHuber = 0.1;

struct Pairs {
  std::vector<PointToLine> lines;
  std::vector<PointToPlane> planes;
};

// Points 2 cm off their lines and planes, one in ten up to a metre, about kTruth. Of the planes one in `x_planes` faces
// along x.
Pairs noisy_pairs(std::size_t lines, std::size_t planes, std::size_t x_planes) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-1, 1);
  std::normal_distribution<double> noise(0, 0.02);
  const auto vector = [&](double scale) { return Eigen::Vector3d(scale * u(rng), scale * u(rng), scale * u(rng)); };
  const auto off = [&](std::size_t i) {
    return i % 10 == 0 ? vector(1) : Eigen::Vector3d(noise(rng), noise(rng), noise(rng));
  };
  Pairs pairs;
  for (std::size_t i = 0; i < lines; ++i) {
    const Eigen::Vector3d q = vector(8);
    pairs.lines.push_back({kTruth.inverse() * (q + off(i)), q, vector(1).normalized()});
  }
  for (std::size_t i = 0; i < planes; ++i) {
    const Eigen::Vector3d q = vector(8);
    const Eigen::Vector3d normal = Eigen::Vector3d::Unit(i % x_planes == 0 ? 0 : 1 + long(i % 2));
    pairs.planes.push_back({kTruth.inverse() * (q + off(i)), q, normal});
  }
  return pairs;
}

AlignResult align_pairs(const Pairs& pairs, const Pose& T, const AlignOptions& options) {
  return align(
      T, options, [&](const Pose&) { return pairs.lines; }, [&](const Pose&) { return pairs.planes; });
}

// FLOAM's residuals, written anew: the area of p, a, b over the length of a b; and n . p + d.
struct LineDistance {
  Eigen::Vector3d p, a, b;
  template <class T>
  bool operator()(const T* q, const T* t, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(q);
    const Eigen::Matrix<T, 3, 1> x = rotation * p.cast<T>() + Eigen::Map<const Eigen::Matrix<T, 3, 1>>(t);
    residual[0] = (x - a.cast<T>()).cross(x - b.cast<T>()).norm() / T((a - b).norm());
    return true;
  }
};
struct PlaneDistance {
  Eigen::Vector3d p, n;
  double d;
  template <class T>
  bool operator()(const T* q, const T* t, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(q);
    residual[0] = n.cast<T>().dot(rotation * p.cast<T>() + Eigen::Map<const Eigen::Matrix<T, 3, 1>>(t)) + T(d);
    return true;
  }
};

Pose align_by_ceres(const Pairs& pairs, const Pose& T) {
  Eigen::Quaterniond q(T.linear());
  Eigen::Vector3d t = T.translation();
  ceres::Problem problem;
  problem.AddParameterBlock(q.coeffs().data(), 4, new ceres::EigenQuaternionManifold);
  const auto add = [&](ceres::CostFunction* cost) {
    problem.AddResidualBlock(cost, new ceres::HuberLoss(kHuber), q.coeffs().data(), t.data());
  };
  for (const PointToLine& pair : pairs.lines) {
    const Eigen::Vector3d half = 0.1 * pair.direction;
    add(new ceres::AutoDiffCostFunction<LineDistance, 1, 4, 3>(
        new LineDistance{pair.source, pair.target + half, pair.target - half}));
  }
  for (const PointToPlane& pair : pairs.planes) {
    add(new ceres::AutoDiffCostFunction<PlaneDistance, 1, 4, 3>(
        new PlaneDistance{pair.source, pair.normal, -pair.normal.dot(pair.target)}));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  EXPECT_TRUE(summary.IsSolutionUsable());
  Pose solution = Pose::Identity();
  solution.linear() = q.normalized().toRotationMatrix();
  solution.translation() = t;
  return solution;
}

TEST(AlignAgainstCeres, FindsTheSamePoseOnLinesAndPlanesWithHubersKernel) {
  AlignOptions options{.max_iterations = 60, .inner_iterations = 4, .kernel = Kernel::huber, .kernel_width = kHuber};
  options.damping = 1e-4;
  options.fitness_epsilon = 0;
  options.transformation_epsilon = options.rotation_epsilon = 1e-12;
  for (const auto& [lines, planes] : {std::pair{200, 600}, std::pair{400, 0}, std::pair{0, 400}, std::pair{30, 900}}) {
    const Pairs pairs = noisy_pairs(std::size_t(lines), std::size_t(planes), 3);
    const Pose start = kTruth * exp((Vector6d() << 0.02, -0.03, 0.05, 0.2, 0.1, -0.1).finished());
    const AlignResult ours = align_pairs(pairs, start, options);
    const Pose theirs = align_by_ceres(pairs, start);
    const Vector6d gap = log(theirs.inverse() * ours.T_target_source);
    EXPECT_LT(gap.head<3>().norm(), 1e-6) << lines << " lines, " << planes << " planes";
    EXPECT_LT(gap.tail<3>().norm(), 1e-6) << lines << " lines, " << planes << " planes";
    EXPECT_LT(log(kTruth.inverse() * ours.T_target_source).norm(), 0.02);
  }
}

TEST(Align, MakesPairsAnewOnlyAfterItsInnerSteps) {
  const Pairs pairs = noisy_pairs(200, 600, 3);
  AlignOptions options{.max_iterations = 2, .inner_iterations = 4};
  int calls = 0;
  const auto counted = [&](const Pose&) { return ++calls, pairs.planes; };
  const Pose start = kTruth * exp((Vector6d() << 0.2, 0.3, -0.4, 1, 1, 1).finished());
  const AlignResult inner = align(start, options, counted);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(inner.iterations, 2);
  options.inner_iterations = 1;
  const AlignResult outer = align(start, options, counted);
  EXPECT_EQ(calls, 4);
  EXPECT_LT(log(kTruth.inverse() * inner.T_target_source).norm(), log(kTruth.inverse() * outer.T_target_source).norm());
}

TEST(Align, HoldsDirectionsOfTooLittleInformationAtThePrediction) {
  const Pairs pairs = noisy_pairs(0, 600, 49);  // thirteen of 600 planes tell of x
  const Pose start = kTruth * Eigen::Translation3d(0.3, 0.1, -0.1);
  AlignOptions options{.kernel = Kernel::huber, .kernel_width = kHuber};
  const AlignResult free = align_pairs(pairs, start, options);
  const Eigen::Vector3d moved_freely = free.T_target_source.translation() - kTruth.translation();
  EXPECT_LT(moved_freely.norm(), 0.05);
  EXPECT_EQ(free.degenerate_directions, 0);
  options.min_information = 100;
  const AlignResult held = align_pairs(pairs, start, options);
  const Eigen::Vector3d left = held.T_target_source.translation() - kTruth.translation();
  EXPECT_EQ(held.degenerate_directions, 1);
  const double start_x = (start.translation() - kTruth.translation()).x();
  EXPECT_NEAR(left.x(), start_x, 0.03);
  EXPECT_LT(left.tail<2>().norm(), 0.05);
}

TEST(Align, KnowsNothingOfAPoseThatWasNotMatched) {
  const AlignResult result = unmatched(kTruth);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.T_target_source.matrix(), kTruth.matrix());
  EXPECT_EQ(result.degenerate_directions, 6);
  EXPECT_TRUE((result.covariance.diagonal().array() > 1e6).all());
}

}  // namespace
}  // namespace tilth

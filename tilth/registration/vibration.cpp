#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include <tilth/registration/vibration.hpp>

namespace tilth {
namespace {

constexpr int kIntervals = ScanVibration::kIntervals;

constexpr int place_of(int knot) {
  return 12 + 6 * knot;
}

// The vibration at a lever l within a part of the scan is A + l B, of [A; B] = M [first knot; second knot].
Matrix12d line_through(double begin, double end) {
  const double width = end - begin;
  const Matrix6d I = Matrix6d::Identity();
  Matrix12d M;
  M << end / width * I, -begin / width * I, -1 / width * I, 1 / width * I;
  return M;
}

// The sums in tilt, yaw and translation.
Eigen::Vector3d by_kind(const Vector6d& values) {
  return {values.head<2>().sum(), values[2], values.tail<3>().sum()};
}

double sinc(double x) {
  const double angle = std::numbers::pi * x;
  return std::abs(angle) < 1e-9 ? 1.0 : std::sin(angle) / angle;
}

}  // namespace

// The correlation of noise of a flat spectrum between two frequencies.
KnotMatrix knot_precision(double duration, const VibrationOptions& options) {
  constexpr double kRest = 0.01;  // of the variance: beside the band
  const double width = options.highest - options.lowest;
  const double middle = 0.5 * (options.highest + options.lowest);
  KnotMatrix correlation;
  for (int apart = 0; apart <= kIntervals; ++apart) {
    const double time = apart * duration / kIntervals;
    const double value = sinc(width * time) * std::cos(2 * std::numbers::pi * middle * time);
    for (int i = 0; i + apart <= kIntervals; ++i) correlation(i, i + apart) = correlation(i + apart, i) = value;
  }
  correlation.diagonal().array() += kRest;
  return correlation.inverse();
}

// With x ~ N(0, s^2), and (1 - a) mean + a x ~ N(0, k^2 s^2 a / 2), where a share k of chance's mean is left.
VibrationPrior vibration_prior(const VibrationSigma& sigma, const ScanVibration& mean, const VibratingScan& scan,
                               const VibrationOptions& options) {
  const double pull = 2 / (options.mean * options.mean), narrowing = 1 + pull * scan.ratio;
  VibrationPrior prior;
  prior.precision = scan.precision;
  prior.sigma_variances = sigma.variances() / scan.scale;
  prior.variances = prior.sigma_variances / narrowing;
  for (std::size_t i = 0; i < mean.knots.size(); ++i)
    prior.means.knots[i] = -pull * (1 - scan.ratio) / narrowing * mean.knots[i];
  return prior;
}

VibrationSystem vibration_system(const SegmentSystems& parts, const ContinuousTimeSystem& smooth,
                                 const VibrationPrior& prior, const MotionState& state) {
  VibrationSystem system;
  system.H.topLeftCorner<12, 12>() = smooth.H;
  system.b.head<12>() = smooth.b;
  const double begin = state.motion.begin, width = state.motion.duration / kIntervals;
  for (int i = 0; i < kIntervals; ++i) {
    const ContinuousTimeSystem& part = parts[std::size_t(i)];
    const Matrix12d M = line_through(begin + i * width, begin + (i + 1) * width), HM = part.H * M;
    const int at = place_of(i);
    system.H.block<12, 12>(at, at) += M.transpose() * HM;
    system.H.block<12, 12>(0, at) += HM;
    system.H.block<12, 12>(at, 0) += HM.transpose();
    system.b.segment<12>(at) += M.transpose() * part.b;
  }
  const Vector6d weights = prior.variances.cwiseInverse();
  for (int i = 0; i <= kIntervals; ++i) {
    for (int j = 0; j <= kIntervals; ++j) {
      const auto k = std::size_t(j);
      const Vector6d joint = prior.precision(i, j) * weights;
      system.H.block<6, 6>(place_of(i), place_of(j)).diagonal() += joint;
      system.b.segment<6>(place_of(i)) += joint.cwiseProduct(state.motion.vibration.knots[k] - prior.means.knots[k]);
    }
  }
  return system;
}

VibrationFactor factor_of(const VibrationSystem& system) {
  return VibrationFactor(system.H);
}

bool step_with_vibration(const VibrationSystem& system, const VibrationFactor& factor, Vector12d& step,
                         ScanVibration& vibration) {
  const VibrationSystem::Vector change = factor.solve(-system.b);
  if (factor.info() != Eigen::Success || !change.allFinite()) return false;
  step = change.head<12>();
  for (int i = 0; i <= kIntervals; ++i) vibration.knots[std::size_t(i)] += change.segment<6>(place_of(i));
  return true;
}

Matrix6d covariance_in_middle(const VibrationFactor& factor) {
  static_assert(kIntervals % 2 == 0, "a knot lies in the middle");
  Eigen::Matrix<double, VibrationSystem::kSize, 6> pick = Eigen::Matrix<double, VibrationSystem::kSize, 6>::Zero();
  pick.topRows<6>().setIdentity();
  pick.middleRows<6>(place_of(kIntervals / 2)).setIdentity();
  const auto half = factor.matrixL().solve(pick).eval();
  return half.transpose() * half;
}

// After MacKay: a coordinate of precision P shows x^T P x of squares, and n - tr(P C) of freedom with C its covariance.
VibrationEvidence evidence_of(const VibrationFactor& factor, const VibrationPrior& prior,
                              const ScanVibration& vibration) {
  const VibrationSystem::Matrix root = factor.matrixL().solve(VibrationSystem::Matrix::Identity());
  Vector6d squares = Vector6d::Zero(), unknown = Vector6d::Zero();
  for (int i = 0; i <= kIntervals; ++i) {
    for (int j = 0; j <= kIntervals; ++j) {
      const Vector6d covariance =  // C = L^-T L^-1
          root.middleCols<6>(place_of(i)).cwiseProduct(root.middleCols<6>(place_of(j))).colwise().sum().transpose();
      squares += prior.precision(i, j) * vibration.knots[std::size_t(i)].cwiseProduct(vibration.knots[std::size_t(j)]);
      unknown += prior.precision(i, j) * covariance.cwiseQuotient(prior.sigma_variances);
    }
  }
  return {by_kind(squares), by_kind(Vector6d::Constant(kIntervals + 1) - unknown)};
}

}  // namespace tilth

// What the registration of a scan that was taken in motion finds.
#pragma once

#include <optional>

#include <tilth/core/scan_motion.hpp>
#include <tilth/registration/align_result.hpp>

namespace tilth {

struct ContinuousTimeAlignment {
  AlignResult pose;                 ///< T_target_source is at `middle`
  MotionInScan motion = {};         ///< about `middle`
  VibrationEvidence evidence = {};  ///< on the size of vibrations
  /// [rad^2, m^2] of the pose at `middle` (right perturbation) if the surfaces were exact, with velocity and vibration
  /// unknown; of the prior, from the last pose on, where the pairs gave none
  Matrix6d covariance = Matrix6d::Zero();
  /// * x is the part of a motion x of the pose that the surfaces say nothing about: there the motion goes on as it was
  Matrix6d dead_reckoned = Matrix6d::Zero();
  std::optional<double> surfaces_seen_at = {};  ///< [s] mean time of the surfaces' patches; none without a pose
};

}  // namespace tilth

// Options of the registration of a scan that was taken in motion.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include <tilth/core/options.hpp>
#include <tilth/registration/vibration_options.hpp>

namespace tilth {

/// How the LiDAR moves within a scan, but for its vibration.
enum class MotionModel { constant_velocity, constant_acceleration };
inline std::span<const std::string_view> names_of(MotionModel) {
  static constexpr std::array<std::string_view, 2> names{"constant_velocity", "constant_acceleration"};
  return names;
}

struct ContinuousTimeOptions {
  int max_iterations = 60;
  double rotation_epsilon = 1e-5;
  double translation_epsilon = 1e-4;
  double max_distance = 2.0;
  double renew_distance = 0.02;
  double min_cosine = 0.8;
  double spread_ratio = 0.1;
  double surface_ratio = 0.3;
  double surface_doubt = 10.0;
  double patch_variance = 7e-5;
  double first_kernel_width = 10.0;
  double kernel_width = 1.3;
  double acceleration = 10.0;
  double angular_acceleration = 20.0;
  MotionModel motion_model = MotionModel::constant_acceleration;
  double velocity_slack = 0.01;
  double velocity_ratio = 0.12;
  VibrationOptions vibration = {};
  double degeneracy_ratio = 2e-3;
  double steady_acceleration = 1.0;
  int min_matches = 20;
};

template <class V>
void visit(ContinuousTimeOptions& o, V&& v) {
  v("max_iterations", o.max_iterations, Bounds{1, 10000}, "[-] associations at most");
  v("rotation_epsilon", o.rotation_epsilon, Bounds{0, 1}, "[rad] stop when a step is smaller", kAdvanced);
  v("translation_epsilon", o.translation_epsilon, Bounds{0, 1}, "[m] stop when a step is smaller", kAdvanced);
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a patch and its match");
  v("renew_distance", o.renew_distance, Bounds{0, 10}, "[m] that a patch moves before its match is looked up anew",
    kAdvanced);
  v("min_cosine", o.min_cosine, Bounds{-1, 1}, "[-] between the normals of a patch and its match", kAdvanced);
  v("spread_ratio", o.spread_ratio, Bounds{0, 1},
    "[-] of a patch's spread along the normal of its surface, added to the variance of its mean", kAdvanced);
  v("surface_ratio", o.surface_ratio, Bounds{0, 1}, "[-] of a surface's variance in that of every pair", kAdvanced);
  v("surface_doubt", o.surface_doubt, Bounds{0, 1e6},
    "[-] the same, divided by the patches that the surface is made of", kAdvanced);
  v("patch_variance", o.patch_variance, Bounds{1e-12, 1}, "[m^2] added to the variance of every pair", kAdvanced);
  v("first_kernel_width", o.first_kernel_width, Bounds{1e-3, 1e9},
    "[sigma] at which the Geman-McClure kernel begins to act in the first iteration; halved in each that follows",
    kAdvanced);
  v("kernel_width", o.kernel_width, Bounds{1e-3, 1e9}, "[sigma] the same in the last iterations", kAdvanced);
  v("acceleration", o.acceleration, Bounds{1e-3, 1e6}, "[m/s^2] standard deviation from constant velocity");
  v("angular_acceleration", o.angular_acceleration, Bounds{1e-3, 1e6}, "[rad/s^2] the same of the rotation");
  v("motion_model", o.motion_model, "[-] within a scan; constant_velocity: that of the motion since the last one");
  v("velocity_slack", o.velocity_slack, Bounds{1e-6, 1e6},
    "[m/s^2, rad/s^2] by which the acceleration in a scan may differ from the one before it", kAdvanced);
  v("velocity_ratio", o.velocity_ratio, Bounds{0, 10},
    "[-] the same as a share of the acceleration's change, in addition", kAdvanced);
  v("vibration", o.vibration, "[-] deviations from constant acceleration within a scan");
  v("degeneracy_ratio", o.degeneracy_ratio, Bounds{0, 1},
    "[-] a direction with less information than this share of the best one is degenerate: there the motion goes "
    "on as it was in the last second, and partly so up to 1.5 times the share",
    kAdvanced);
  v("steady_acceleration", o.steady_acceleration, Bounds{1e-6, 1e6}, "[m/s^2, rad/s^2] standard deviation from that",
    kAdvanced);
  v("min_matches", o.min_matches, Bounds{6, 1e9}, "[-] pairs below which the predicted pose is kept", kAdvanced);
}

}  // namespace tilth

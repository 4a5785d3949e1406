#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <tilth/simulation/counter_random.hpp>
#include <tilth/simulation/motion.hpp>
#include <tilth/simulation/smooth_step.hpp>

namespace tilth {
namespace {

constexpr double kBlend = 1.6;     // [s] at nominal speed, over which a leg takes up its own speed
constexpr double kCruise = 0.2;    // [m/s] above which roll, pitch and weave reach their full size
constexpr int kStepsPerPose = 10;  // of the integration of speed and heading
constexpr std::uint64_t kWobbleStream = 0xA0, kVibrationStream = 0xB0;

struct Planar {
  double x = 0, y = 0, yaw = 0, speed = 0;
};

/// The legs as functions of time.
class Profile {
 public:
  Profile(std::span<const Leg> legs, double scale) : legs_(legs), scale_(scale) {}

  double speed(double time) const {
    const auto [leg, elapsed, before, yaw] = find(time);
    if (!leg) return before;
    return before + (scale_ * leg->speed - before) * smooth_step(elapsed * scale_ / std::min(kBlend, leg->duration));
  }

  double yaw(double time) const {
    const auto [leg, elapsed, before, yaw] = find(time);
    return leg ? yaw + leg->turn * smooth_step(elapsed * scale_ / leg->duration) : yaw;
  }

 private:
  struct Place {
    const Leg* leg;
    double elapsed, speed_before, yaw_before;
  };

  Place find(double time) const {
    double speed = 0, yaw = 0;
    for (const Leg& leg : legs_) {
      const double duration = leg.duration / scale_;
      if (time < duration) return {&leg, time, speed, yaw};
      time -= duration, speed = scale_ * leg.speed, yaw += leg.turn;
    }
    return {nullptr, 0, speed, yaw};
  }

  std::span<const Leg> legs_;
  double scale_;
};

/// A sum of three slow waves, within [-1, 1], the same for the same seed.
class SlowWave {
 public:
  SlowWave(std::uint64_t seed, std::uint64_t stream) {
    CounterRandom random(seed, stream);
    for (Wave& wave : waves_) wave = {random.uniform(0.15, 1.1), random.uniform(0, 2 * std::numbers::pi)};
  }

  double at(double time) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(2 * std::numbers::pi * wave.frequency * time + wave.phase);
    return sum / double(waves_.size());
  }

 private:
  struct Wave {
    double frequency, phase;  // [Hz], [rad]
  };
  std::array<Wave, 3> waves_;
};

/// Vibration of an engine or a cart: three tones of 9 to 23 Hz in each of six coordinates, of deviation 1.
double vibration(std::uint64_t seed, int axis, double time) {
  CounterRandom random(seed, kVibrationStream + std::uint64_t(axis));
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double frequency = random.uniform(9, 23), phase = random.uniform(0, 2 * std::numbers::pi);
    sum += std::sin(2 * std::numbers::pi * frequency * time + phase);
  }
  return sum * std::sqrt(2.0 / 3.0);
}

struct Sway {
  SlowWave roll, pitch, heave, weave;
};

Pose with_sway(const Planar& at, double time, const Sway& sway, const MotionOptions& options) {
  const double ratio = smooth_step(std::abs(at.speed) / kCruise);
  const double roll = ratio * options.wobble * sway.roll.at(time);
  const double pitch = ratio * options.wobble * sway.pitch.at(time);
  Pose T = Pose::Identity();
  T.translation() = Eigen::Vector3d(at.x, at.y, ratio * 0.003 * sway.heave.at(time));
  T.linear() = (Eigen::AngleAxisd(at.yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return shaken(T, time, options);
}

/// The weave turns the heading to and fro; the platform follows where it points.
void advance(Planar& at, const Profile& profile, const Sway& sway, double time, const MotionOptions& options) {
  const double dt = 1 / (kTruthRate * kStepsPerPose), middle = time + 0.5 * dt;
  const auto heading = [&](double t) {
    const double speed = profile.speed(t);
    return profile.yaw(t) + options.weave * smooth_step(std::abs(speed) / kCruise) * sway.weave.at(t);
  };
  const double speed = profile.speed(middle), yaw = heading(middle);
  at.x += speed * dt * std::cos(yaw), at.y += speed * dt * std::sin(yaw);
  at.yaw = heading(time + dt), at.speed = profile.speed(time + dt);
}

}  // namespace

Pose shaken(const Pose& T_world_lidar, double time, const MotionOptions& options) {
  if (options.vibration == 0 && options.vibration_angle == 0) return T_world_lidar;
  Vector6d shake;
  for (int axis = 0; axis < 6; ++axis) {
    shake[axis] = (axis < 3 ? options.vibration_angle : options.vibration) * vibration(options.seed, axis, time);
  }
  return retract(T_world_lidar, shake);
}

double duration_of(std::span<const Leg> legs, const MotionOptions& options) {
  double sum = 0;
  for (const Leg& leg : legs) sum += leg.duration;
  return sum / options.speed_scale;
}

Trajectory drive(std::span<const Leg> legs, const Pose& T_world_start, const MotionOptions& options) {
  const Profile profile(legs, options.speed_scale);
  const Sway sway{SlowWave(options.seed, kWobbleStream), SlowWave(options.seed, kWobbleStream + 1),
                  SlowWave(options.seed, kWobbleStream + 2), SlowWave(options.seed, kWobbleStream + 3)};
  const auto poses = std::size_t(std::ceil(duration_of(legs, options) * kTruthRate)) + 1;
  Trajectory trajectory;
  Planar at;
  for (std::size_t i = 0; i < poses; ++i) {
    const double time = double(i) / kTruthRate;
    trajectory.push_back({time, T_world_start * with_sway(at, time, sway, options)});
    for (int k = 0; k < kStepsPerPose; ++k) {
      advance(at, profile, sway, time + k / (kTruthRate * kStepsPerPose), options);
    }
  }
  return trajectory;
}

}  // namespace tilth

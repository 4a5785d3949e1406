// What a receiver makes of a beam that met something: losses, mirrors, mixed pixels, false ranges, noise. Each effect
// has a rate of its own in NoiseOptions; the figures behind them are rough readings of what mechanical LiDARs show.
#pragma once

#include <optional>

#include <tilth/simulation/counter_random.hpp>
#include <tilth/simulation/simulate_scan.hpp>

namespace tilth {

struct Echo {
  double range = 0.0;  ///< [m] before noise
  PointKind kind = PointKind::surface;
  double edge_distance = 0.0;  ///< [m]
  double intensity = 0.0;      ///< 0 .. 255
  double cosine = 1.0;         ///< of incidence
};

/// The beam that goes on from a mirror or through a pane, where this beam does; nothing where it is scattered back.
struct Onward {
  Ray ray;
  bool mirrored = false;
};
std::optional<Onward> onward(const Ray& ray, const Hit& hit, const NoiseOptions& options, CounterRandom& random);

/// The echo of a beam that is scattered back at `hit`, or nothing where it is lost.
std::optional<Echo> echo_of(const Ray& ray, const Hit& hit, const NoiseOptions& options, CounterRandom& random);

/// The echo after a mirror or a pane, as the receiver takes it: straight on, `before` [m] further.
std::optional<Echo> onward_echo(const Onward& next, const Hit& hit, double before);

/// A ray and what it meets.
struct Sight {
  const Ray& ray;
  const Hit& hit;

  Eigen::Vector3d point() const { return ray.origin + hit.distance * ray.direction; }
};

/// A range between the two that share the beam, where they lie far enough apart to be two surfaces.
void mix(Echo& echo, const Sight& seen, const Sight& beside, const NoiseOptions& options, CounterRandom& random);

/// A range where nothing is: dust before the first surface met or a stray pulse behind it, 0.3 m off at least.
void stray(Echo& echo, const Hit& seen, const NoiseOptions& options, CounterRandom& random);

/// Noise and the packets' step; nothing where the range falls outside what the sensor reports.
std::optional<double> measured_range(const Echo& echo, const LidarModel& lidar, const NoiseOptions& options,
                                     CounterRandom& random);

}  // namespace tilth

// One revolution of a spinning LiDAR in a world: every beam is cast from the sensor's pose at its own time, so the scan
// carries true motion distortion; or all from one pose, as Gazebo's sensors do. About 15 ms for 28,800 beams on one
// core.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <tilth/core/options.hpp>
#include <tilth/core/point_label.hpp>
#include <tilth/core/scan.hpp>
#include <tilth/core/trajectory.hpp>
#include <tilth/simulation/beam_flaws.hpp>
#include <tilth/simulation/world.hpp>

namespace tilth {

struct NoiseOptions {
  double noise = 0.02;        ///< [m] deviation of a range
  double outliers = 0.01;     ///< share of the beams that report a range of no surface
  double mixed = 0.5;         ///< share of the beams across a depth edge that report a range between
  double divergence = 0.003;  ///< [rad] full angle of the beam
  double ghosts = 0.3;        ///< share of the beams that just touch metal or glass that report what it mirrors
  double grazing = 0.9;       ///< share of the beams lost on matte surfaces that they just touch
  double glossy = 0.9;        ///< the same on polished and metal surfaces, which lose them from steeper angles on
  bool quantize = true;       ///< ranges in whole steps of the sensor's packets
  bool snapshot = false;      ///< all beams from the pose at the start of the scan, without times
};

template <class V>
void visit(NoiseOptions& o, V&& v) {
  v("noise", o.noise, Bounds{0, 1}, "[m] standard deviation of a range");
  v("outliers", o.outliers, Bounds{0, 1}, "[-] share of the beams that report a range where no surface is");
  v("mixed", o.mixed, Bounds{0, 1}, "[-] share of the beams across a depth edge that report a range between the two");
  v("divergence", o.divergence, Bounds{0, 0.05}, "[rad] full opening angle of a beam");
  v("ghosts", o.ghosts, Bounds{0, 1},
    "[-] share of the beams that just touch metal or glass that report what it mirrors");
  v("grazing", o.grazing, Bounds{0, 1}, "[-] share of the beams lost that just touch a matte surface");
  v("glossy", o.glossy, Bounds{0, 1}, "[-] share of the beams lost that just touch a polished floor or bare metal");
  v("quantize", o.quantize, "[-] ranges in whole steps of the sensor's packets");
  v("snapshot", o.snapshot, "[-] all beams of a scan from one pose at one time, as Gazebo does");
}

/// What Gazebo's sensors do: a snapshot with Gaussian noise of 8 mm on the range and no other imperfection.
NoiseOptions gazebo_noise();

inline constexpr double kEdgeReach = 0.05;  ///< [m] from an edge within which a point counts as on it

std::span<const std::string_view> names_of(PointKind);

struct LabelledScan {
  Scan scan;                         ///< points in firing order; times are empty in a snapshot
  std::vector<std::uint8_t> labels;  ///< one a point
};

/// Which scan of which sequence: the random numbers depend on seed, index and beam alone.
struct ScanKey {
  double stamp = 0.0;  ///< [s] at which the first beam fires
  std::uint64_t seed = 1;
  std::uint64_t index = 0;
};

/// The scan of that key. The trajectory gives the LiDAR in the world and must cover the scan. A beam with errors is
/// cast where it truly points; its range is reported along the direction it should have, noise and steps on top.
LabelledScan simulate_scan(const World& world, const FlawedLidar& sensor, const Trajectory& trajectory,
                           const NoiseOptions& options, const ScanKey& key);

}  // namespace tilth

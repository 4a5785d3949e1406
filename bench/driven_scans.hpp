// Scans of a drive through a simulated scene (seed 101, a VLP-16 that moves; an HDL-64 in the street), and what a
// registration starts from: the same for every benchmark of a stage that needs more than one scan.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tilth/features/patch_features.hpp>
#include <tilth/features/surface_patches.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/preprocess/ring_support.hpp>
#include <tilth/simulation/simulator.hpp>

namespace tilth::bench {

inline constexpr const char* kScenes[] = {"corridor", "plaza", "street"};
inline constexpr std::size_t kFirst = 250;  ///< number of the scan that is measured; the robot drives by then
inline constexpr std::size_t kBefore = 50;  ///< scans before it that make the map

inline Simulator simulator(std::int64_t scene) {
  const std::string name = kScenes[scene];
  return Simulator(name, simulation_options(name, {{"seed", "101"}}));
}

/// The patches of a scan, as the pipelines make them, seen from its middle and straightened by the true motion.
struct StillScan {
  SurfacePatches patches;
  Pose T_world_middle = Pose::Identity();
};

inline StillScan still_scan(const Simulator& simulator, std::size_t index) {
  const Scan scan = simulator.scan(index).scan;
  RingLayout rings;
  arrange(scan.cloud, rings);
  const auto keep = ring_support(rings, scan.cloud.size(), RingSupportOptions());
  const SurfacePatches patches = surface_patches(scan.cloud, rings, keep.value(), PatchOptions());
  const double length = duration(scan.cloud), middle = 0.5 * length;
  const auto pose_at = [&](double time) { return interpolate(simulator.truth(), scan.stamp + time); };
  const Vector6d velocity = log(pose_at(0).inverse() * pose_at(length)) / length;
  return {deskew(patches, {velocity}, middle), pose_at(middle)};
}

/// A scan, its features, and the map of the scans before it, in the world's frame.
struct RegistrationCase {
  StillScan scan;
  SurfacePatches features;
  PatchMap map{PatchMapOptions()};
};

inline RegistrationCase registration_case(std::int64_t scene) {
  const Simulator drive = simulator(scene);
  RegistrationCase c;
  c.scan = still_scan(drive, kFirst);
  const PatchFeatures features = patch_features(c.scan.patches, FeatureOptions());
  c.features = features.edges;
  c.features.insert(c.features.end(), features.planes.begin(), features.planes.end());
  for (std::size_t i = kFirst - kBefore; i < kFirst; ++i) {
    const StillScan before = still_scan(drive, i);
    c.map.insert(before.patches, before.T_world_middle);
  }
  return c;
}

}  // namespace tilth::bench

// Scan to scan in two steps (LeGO-LOAM, Shan and Englot 2018, section III-D): the ground gives roll, pitch and z,
// then edges give yaw, x and y.
#pragma once

#include <tilth/registration/align.hpp>
#include <tilth/registration/scan_association.hpp>

namespace tilth {

/// A step of the original: a twentieth of that of Gauss-Newton at a time, until less than 0.1 degree and 1 mm is left
/// of it.
constexpr AlignOptions scan_step(Freedom active) {
  AlignOptions options;
  options.max_iterations = 25;
  options.transformation_epsilon = 1e-3;
  options.rotation_epsilon = 1.74533e-3;
  options.fitness_epsilon = 0;
  options.min_information = 10;
  options.min_matches = 10;
  options.active = active;
  options.step_ratio = 0.05;
  return options;
}

struct ScanToScanOptions {
  ScanMatchOptions matches;
  AlignOptions ground_step = scan_step(Freedom::roll_pitch_z);
  AlignOptions edge_step = scan_step(Freedom::yaw_x_y);
  int min_edges = 10;
  int min_planes = 100;
};

template <class V>
void visit(ScanToScanOptions& o, V&& v) {
  v("matches", o.matches, "[-] what points are matched with");
  v("ground_step", o.ground_step, "[-] planes, for roll, pitch and z");
  v("edge_step", o.edge_step, "[-] edges, for yaw, x and y");
  v("min_edges", o.min_edges, Bounds{2, 1e9}, "[points] of the last scan below which the motion predicted is kept");
  v("min_planes", o.min_planes, Bounds{3, 1e9}, "[points] of the last scan likewise");
}

/// The points that are matched, with their times; the scan lasts `period` [s].
struct TimedFeatures {
  const PointCloud& edges;
  const PointCloud& planes;
  double period;
};

/// The points that they are matched with, as the LiDAR sees them at the end of the last scan.
struct ScanTargets {
  ScanTarget edges{PointCloud{}}, planes{PointCloud{}};
};

/// T_target_source is the LiDAR at the end of the scan seen from its start, T_init before. Information and covariance
/// are those of both steps' pairs.
AlignResult align_scan_to_scan(const TimedFeatures& scan, const ScanTargets& targets, const Pose& T_init,
                               const ScanToScanOptions& options);

}  // namespace tilth

// Scan Context (Kim and Kim, IROS 2018): a place as the greatest heights in rings and sectors about the sensor, which
// turning only shifts. Rings grow with the distance, so that a room and a street both fill them. O(points) to make,
// O(rings * sectors^2) to compare.
#pragma once

#include <Eigen/Core>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>

namespace tilth {

struct ScanContextOptions {
  int rings = 20;
  int sectors = 60;
  double min_range = 1.0;
  double max_range = 80.0;
  double floor = -3.0;
};

template <class V>
void visit(ScanContextOptions& o, V&& v) {
  v("rings", o.rings, Bounds{2, 200}, "[-] of the descriptor of a place, each wider than the one within");
  v("sectors", o.sectors, Bounds{4, 720}, "[-] of the descriptor of a place");
  v("min_range", o.min_range, Bounds{0.1, 1000}, "[m] from the axis; nearer points are left out");
  v("max_range", o.max_range, Bounds{0.2, 1000}, "[m] from the axis; farther points are left out");
  v("floor", o.floor, Bounds{-100, 0},
    "[m] heights are counted from here, seen from the sensor; what is lower is left out");
}

struct ScanContext {
  Eigen::MatrixXf heights;   ///< [m] rings x sectors; 0 where nothing is
  Eigen::VectorXf ring_key;  ///< the share of each ring's sectors where something is: the same whatever the heading
};

ScanContext describe_place(const PointCloud& cloud, const ScanContextOptions& options);

struct ContextMatch {
  double distance = 1.0;  ///< [-] mean of 1 - cosine over sectors, in [0, 1]
  double yaw = 0.0;       ///< [rad] in (-pi, pi]: Rz(yaw) turns the query's frame into the candidate's
};

/// The best of all shifts by whole sectors.
ContextMatch compare(const ScanContext& query, const ScanContext& candidate);

}  // namespace tilth

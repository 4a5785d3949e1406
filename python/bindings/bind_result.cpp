// tilth.Result: what an odometry made of one scan.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "docstrings.hpp"
#include "names.hpp"
#include "result.hpp"
#include <tilth/preprocess/deskew.hpp>

namespace tilth::python {
namespace {

using ResultClass = nb::class_<ScanResult>;

/// A property that reads one member of the result.
template <class F>
void add_property(ResultClass& result, const char* name, const F& of, const char* doc) {
  result.def_prop_ro(
      name, [of](const ScanResult& self) { return of(self.result); }, nb::rv_policy::automatic, doc);
}

void add_pose(ResultClass& result) {
  using R = const OdometryResult&;
  add_property(
      result, "stamp", [](R r) { return r.stamp; },
      "[s] of the pose: the middle of the scan where its points have times, else its stamp.");
  add_property(
      result, "T_world_lidar", [](R r) { return array_of(r.T_world_lidar); },
      "(4, 4) pose at `stamp`: maps points of the LiDAR frame into the world, the LiDAR at the first scan.");
  add_property(
      result, "covariance", [](R r) { return array_of(r.covariance.value_or(r.alignment.covariance)); },
      "(6, 6) [rad^2, m^2] of the pose, rotation first, in the LiDAR frame (right perturbation); with the drift "
      "where the pipeline accounts for it.");
  add_property(
      result, "information", [](R r) { return array_of(r.alignment.information); },
      "(6, 6) J^T J of the registration's last iteration, rotation first, in the LiDAR frame.");
  add_property(
      result, "velocity", [](R r) { return array_of(r.motion.velocity); },
      "(6,) [rad/s, m/s] at `stamp`, in the LiDAR frame.");
}

void add_diagnosis(ResultClass& result) {
  using R = const OdometryResult&;
  add_property(
      result, "track", [](R r) { return name_of(r.track.state); },
      "'tracking', 'coasting' (predicted only), 'lost' (wrong, or likely so) or 'recovered'.");
  add_property(
      result, "track_reason", [](R r) { return name_of(r.track.reason); },
      "Why it is not 'tracking', in words; '' where it is.");
  add_property(
      result, "degenerate_directions", [](R r) { return r.alignment.degenerate_directions; },
      "How many of the six directions the scan does not determine.");
  add_property(
      result, "ambiguous", [](R r) { return r.ambiguous; }, "Another motion fits as well as the one taken.");
  add_property(
      result, "relative", [](R r) { return r.relative; }, "To a map that was begun after a loss.");
  add_property(
      result, "converged", [](R r) { return r.alignment.converged; }, "The registration came to its end.");
}

void add_counts(ResultClass& result) {
  using R = const OdometryResult&;
  add_property(
      result, "iterations", [](R r) { return r.alignment.iterations; }, "Of the registration.");
  add_property(
      result, "candidates", [](R r) { return r.alignment.candidates; }, "Source points that were looked up.");
  add_property(
      result, "matches", [](R r) { return r.alignment.matches; }, "Pairs of the last iteration.");
  add_property(
      result, "weight", [](R r) { return r.alignment.weight; }, "Sum of the matches' weights by the kernel.");
  add_property(
      result, "error", [](R r) { return r.alignment.error; }, "Half the weighted sum of squared residuals.");
  add_property(
      result, "points_in", [](R r) { return r.counts.points_in; }, "Finite points within range.");
  add_property(
      result, "outliers", [](R r) { return r.counts.outliers; }, "Points that the outlier filter removed.");
  add_property(
      result, "edges", [](R r) { return r.counts.edges; }, "Edge features.");
  add_property(
      result, "planes", [](R r) { return r.counts.planes; }, "Plane features.");
}

void add_clouds(ResultClass& result) {
  result
      .def_prop_ro(
          "filtered",
          [](const ScanResult& self) {
            return Scan{self.scan_stamp, self.result.filtered};
          },
          "Scan without outliers, as measured (not deskewed).")
      .def_prop_ro(
          "deskewed", [](const ScanResult& self) { return array_of(self.deskewed().points); }, nb::rv_policy::automatic,
          "(n, 3) [m] the points of `filtered` as seen all at once from the LiDAR at `stamp`: "
          "deskewed @ R.T + t, with R, t of T_world_lidar, lie in the world.")
      .def("__repr__", [](const ScanResult& self) {
        return "Result(stamp=" + std::to_string(self.result.stamp) + ", track='" + name_of(self.result.track.state) +
               "', matches=" + std::to_string(self.result.alignment.matches) + ")";
      });
}

}  // namespace

PointCloud ScanResult::deskewed() const {
  return deskew(result.filtered, result.motion, result.stamp - scan_stamp);
}

void add_result(nb::module_& module) {
  ResultClass result(module, "Result", kResultDoc);
  add_pose(result);
  add_diagnosis(result);
  add_counts(result);
  add_clouds(result);
}

}  // namespace tilth::python

// A saved map in which Python finds scan after scan.
#include <memory>
#include <mutex>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <optional>

#include "arrays.hpp"
#include "bindings.hpp"
#include "names.hpp"
#include "result.hpp"
#include <tilth/atlas/map_folder.hpp>
#include <tilth/localization/localizer.hpp>
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::python {
namespace {

struct Located {
  LocatedScan scan;
  double scan_stamp = 0.0;  ///< [s] of the scan's first point
};

/// One thread at a time, stamps that ascend.
class MapLocalizer {
 public:
  MapLocalizer(const std::string& folder, const std::string& pipeline, const OptionValues& values,
               const OptionValues& localize, nb::handle T_map_guess)
      : map_(folder), localizer_(made(pipeline, values, localize, T_map_guess)) {}

  Located add(const Scan& scan) {
    const std::unique_lock<std::mutex> alone(busy_, std::try_to_lock);
    if (!alone) throw Error("this localizer", "is at work in another thread: each thread needs one of its own");
    if (last_stamp_ && scan.stamp <= *last_stamp_)
      throw Error("stamp", "is " + std::to_string(scan.stamp) + " s, expected one after the last scan's, " +
                               std::to_string(*last_stamp_) + " s");
    last_stamp_ = scan.stamp;
    return {localizer_->add(scan), scan.stamp};
  }

  void forget() {
    localizer_->forget();
    last_stamp_.reset();
  }

 private:
  std::unique_ptr<Localizer> made(const std::string& pipeline, const OptionValues& values, const OptionValues& localize,
                                  nb::handle T_map_guess) const {
    make_odometry(pipeline, values);  // refuses what is wrong before the first scan
    std::optional<Pose> guess;
    if (!T_map_guess.is_none()) guess = pose_of(T_map_guess, "T_map_lidar");
    return std::make_unique<Localizer>(
        map_, [pipeline, values] { return make_odometry(pipeline, values); },
        with<LocalizationOptions>(localize).localize, guess);
  }

  MapFolder map_;
  std::unique_ptr<Localizer> localizer_;
  std::mutex busy_;
  std::optional<double> last_stamp_;
};

std::vector<Pose> hypotheses_of(const Located& located) {
  std::vector<Pose> poses;
  for (const PlaceFit& fit : located.scan.hypotheses) poses.push_back(fit.T_map_lidar);
  return poses;
}

void add_located(nb::module_& module) {
  nb::class_<Located>(module, "Located", "Where in a saved map one scan was taken.")
      .def_prop_ro(
          "stamp", [](const Located& l) { return l.scan.odometry.stamp; }, "[s] of the pose, as of a Result.")
      .def_prop_ro(
          "state", [](const Located& l) { return name_of(l.scan.state); },
          "'searching', 'ambiguous' (several places fit alike: `hypotheses`), 'located', 'coasting' (by odometry "
          "alone) or 'lost'.")
      .def_prop_ro(
          "T_map_lidar",
          [](const Located& l) {
            return l.scan.T_map_lidar ? std::optional(array_of(*l.scan.T_map_lidar)) : std::nullopt;
          },
          nb::rv_policy::automatic, "(4, 4) pose in the map's frame at `stamp`; None where it is not known.")
      .def_prop_ro(
          "covariance", [](const Located& l) { return array_of(l.scan.covariance); }, nb::rv_policy::automatic,
          "(6, 6) [rad^2, m^2] of that pose, rotation first, in the LiDAR frame (right perturbation).")
      .def_prop_ro(
          "overlap", [](const Located& l) { return l.scan.overlap; },
          "Share of the last scan that was registered to the map that lies on its surfaces.")
      .def_prop_ro(
          "through", [](const Located& l) { return l.scan.through; }, "Share of its beams that pass through surfaces.")
      .def_prop_ro(
          "hypotheses", [](const Located& l) { return array_of(hypotheses_of(l)); }, nb::rv_policy::automatic,
          "(n, 4, 4) poses in the map that a search at this scan could not tell apart, the best first.")
      .def_prop_ro(
          "odometry",
          [](const Located& l) {
            return ScanResult{l.scan.odometry, l.scan_stamp};
          },
          "The odometry's Result of the same scan.")
      .def("__repr__", [](const Located& l) { return "Located(state='" + name_of(l.scan.state) + "')"; });
}

}  // namespace

void add_localizer(nb::module_& module) {
  add_located(module);
  nb::class_<MapLocalizer>(module, "Localizer")
      .def(nb::init<const std::string&, const std::string&, const OptionValues&, const OptionValues&, nb::handle>(),
           nb::arg("map"), nb::arg("pipeline"), nb::arg("values"), nb::arg("localize"), nb::arg("T_map_lidar").none())
      .def("add", &MapLocalizer::add, nb::arg("scan"), nb::call_guard<nb::gil_scoped_release>())
      .def("forget", &MapLocalizer::forget);
}

}  // namespace tilth::python

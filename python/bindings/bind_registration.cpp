// Two clouds registered, from a guess or from nothing.
#include <limits>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "docstrings.hpp"
#include "finite_points.hpp"
#include "names.hpp"
#include <tilth/localization/find_cloud.hpp>

namespace tilth::python {
namespace {

FoundCloud register_about(const PointCloud& source, const PointCloud& target, const Pose& T_init,
                          const AlignCloudsOptions& options) {
  FoundCloud found{.registration = align_clouds(source, target, T_init, options)};
  if (!found.registration.converged) return found;
  found.answer = PlaceAnswer::found;
  found.hypotheses = {found.registration.T_target_source};
  return found;
}

FoundCloud register_scans(const Scan& source, const Scan& target, nb::handle T_init, const OptionValues& values) {
  if (T_init.is_none()) {
    const auto options = with<FindCloudOptions>(values);
    const nb::gil_scoped_release unlocked;
    FoundCloud found = find_cloud(FinitePoints(source.cloud).cloud, FinitePoints(target.cloud).cloud, options);
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (found.answer != PlaceAnswer::found) found.registration.T_target_source.matrix().setConstant(kNone);
    return found;
  }
  const auto options = with<AlignCloudsOptions>(values);
  const Pose T_start = pose_of(T_init, "T_init");
  const nb::gil_scoped_release unlocked;
  return register_about(FinitePoints(source.cloud).cloud, FinitePoints(target.cloud).cloud, T_start, options);
}

}  // namespace

void add_registration(nb::module_& module) {
  using F = const FoundCloud&;
  nb::class_<FoundCloud> registration(module, "Registration", kRegistrationDoc);
  registration
      .def_prop_ro(
          "T_target_source", [](F f) { return array_of(f.registration.T_target_source); }, nb::rv_policy::automatic,
          "(4, 4): source @ R.T + t lies on the target. Not converged: T_init, or NaN where there was none.")
      .def_prop_ro(
          "covariance", [](F f) { return array_of(f.registration.covariance); }, nb::rv_policy::automatic,
          "(6, 6) [rad^2, m^2], rotation first, in the source's frame (right perturbation).")
      .def_prop_ro(
          "information", [](F f) { return array_of(f.registration.information); }, nb::rv_policy::automatic,
          "(6, 6) J^T J of the last iteration.")
      .def_prop_ro(
          "answer", [](F f) { return name_of(f.answer); },
          "'found', 'ambiguous' (several places fit alike: `hypotheses`) or 'not_found'.")
      .def_prop_ro(
          "hypotheses", [](F f) { return array_of(f.hypotheses); }, nb::rv_policy::automatic,
          "(n, 4, 4) of T_target_source that may be, the best first.")
      .def_prop_ro(
          "converged", [](F f) { return f.registration.converged; }, "False: not found, or too little matched.");
  const auto field = [&](const char* name, auto AlignResult::*member, const char* doc) {
    registration.def_prop_ro(
        name, [member](F f) { return f.registration.*member; }, doc);
  };
  field("iterations", &AlignResult::iterations, "Of all steps.");
  field("candidates", &AlignResult::candidates, "Source patches that were looked up.");
  field("matches", &AlignResult::matches, "Pairs of the last iteration.");
  field("weight", &AlignResult::weight, "Sum of the matches' weights by the kernel.");
  field("error", &AlignResult::error, "Half the weighted sum of squared residuals.");
  field("degenerate_directions", &AlignResult::degenerate_directions,
        "How many of the six directions the clouds do not determine.");
  module.def("register", &register_scans, nb::arg("source"), nb::arg("target"), nb::arg("T_init").none(),
             nb::arg("values"));
}

}  // namespace tilth::python

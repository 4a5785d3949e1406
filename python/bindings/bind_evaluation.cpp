// tilth.evaluate: the judge of the program.
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "option_rows.hpp"
#include <tilth/run/evaluation_report.hpp>
#include <tilth/run/truth_file.hpp>

namespace tilth::python {
namespace {

/// A trajectory with where it comes from, as the judge takes it.
struct JudgedPoses {
  TruthFile file;
};

Evaluation evaluate_poses(const JudgedPoses& truth, const JudgedPoses& estimate, const OptionValues& values) {
  const nb::gil_scoped_release unlocked;
  return judge(truth.file, estimate.file.poses, with<EvaluationOptions>(values));
}

void add_poses(nb::module_& module) {
  nb::class_<JudgedPoses>(module, "JudgedPoses")
      .def_static("read", [](const std::string& path,
                             const std::string& calibration) { return JudgedPoses{read_truth(path, calibration)}; })
      .def_static("of",
                  [](nb::handle stamps, nb::handle poses, const std::string& name) {
                    return JudgedPoses{{name, {trajectory_of(stamps, poses, name), true, {}}, {}, false, {}}};
                  })
      .def("trajectory",
           [](const JudgedPoses& self) {
             return std::pair(stamps_array(self.file.poses.trajectory), poses_array(self.file.poses.trajectory));
           })
      .def("has_stamps", [](const JudgedPoses& self) { return self.file.poses.has_stamps; })
      .def("notices", [](const JudgedPoses& self) { return self.file.poses.notices; });
}

}  // namespace

void add_evaluation(nb::module_& module) {
  using E = const Evaluation&;
  add_poses(module);
  nb::class_<Evaluation>(module, "Evaluation")
      .def("json", [](E e) { return evaluation_json(e); })
      .def("table", [](E e) { return evaluation_table(e); })
      .def("ape_errors",
           [](E e) { return std::pair(column_array(e.ape.translation.errors), column_array(e.ape.rotation.errors)); })
      .def("rpe_errors",
           [](E e) { return std::pair(column_array(e.rpe.translation.errors), column_array(e.rpe.rotation.errors)); })
      .def("truth", [](E e) { return std::pair(stamps_array(e.matches.truth), poses_array(e.matches.truth)); })
      .def("estimate",
           [](E e) { return std::pair(stamps_array(e.matches.estimate), poses_array(e.matches.estimate)); });
  module.def("evaluate", &evaluate_poses);
  module.def("describe_evaluation", [] { return option_rows(describe(EvaluationOptions{})); });
}

}  // namespace tilth::python

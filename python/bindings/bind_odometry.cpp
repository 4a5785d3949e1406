// The odometry and the SLAM that Python feeds scan by scan, and the options of the pipelines.
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "motion_prior_file.hpp"
#include "option_rows.hpp"
#include "records.hpp"
#include "registrar.hpp"
#include <tilth/core/error.hpp>
#include <tilth/odometry/make_odometry.hpp>

namespace tilth::python {
namespace {

using Unlocked = nb::call_guard<nb::gil_scoped_release>;

std::vector<std::pair<std::string, std::string>> pipeline_rows() {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const PipelineInfo& info : pipelines()) rows.emplace_back(info.name, info.summary);
  return rows;
}

PointArray local_map_of(const Registrar& odometry) {
  PointCloud map;
  {
    const nb::gil_scoped_release unlocked;
    map = odometry.local_map();
  }
  return array_of(std::move(map.points));
}

std::shared_ptr<const RunRecord> closed(SlamRegistrar& slam) {
  const nb::gil_scoped_release unlocked;
  return slam.closed();
}

std::unique_ptr<Odometry> made(const std::string& pipeline, const OptionValues& values, const ExternalMotion* prior) {
  return make_odometry(pipeline, values, prior == nullptr ? nullptr : std::make_shared<const ExternalMotion>(*prior));
}

void make_slam(SlamRegistrar* self, const std::string& pipeline, const OptionValues& values,
               const ExternalMotion* prior, const std::pair<OptionValues, OptionValues>& loop_and_map) {
  const auto& [loop, map] = loop_and_map;
  new (self)
      SlamRegistrar(with_loop_closure({made(pipeline, values, prior)}, with<SlamOptions>(loop)), with<MapOptions>(map));
}

ExternalMotion prior_in(const std::string& file) {
  if (file.empty()) throw Error("prior", "names no file");
  return *app::read_prior(file);
}

void add_prior(nb::module_& module) {
  nb::class_<ExternalMotion>(module, "ExternalMotion")
      .def_static("read", &prior_in)
      .def_static("of", [](nb::handle stamps, nb::handle poses) {
        return ExternalMotion(trajectory_of(stamps, poses, "prior"));
      });
}

}  // namespace

void add_odometry(nb::module_& module) {
  add_prior(module);
  nb::class_<Registrar>(module, "Odometry")
      .def(
          "__init__",
          [](Registrar* self, const std::string& pipeline, const OptionValues& values, const ExternalMotion* prior) {
            new (self) Registrar(made(pipeline, values, prior));
          },
          nb::arg("pipeline"), nb::arg("values"), nb::arg("prior").none())
      .def("register_scan", &Registrar::register_scan, nb::arg("scan"), Unlocked())
      .def("local_map", &local_map_of);
  module.def("pipelines", &pipeline_rows);
  module.def("describe_odometry", [](const std::string& pipeline, const OptionValues& values) {
    return option_rows(describe_odometry(pipeline, values));
  });
}

void add_slam(nb::module_& module) {
  nb::class_<SlamRegistrar, Registrar>(module, "Slam")
      .def("__init__", &make_slam, nb::arg("pipeline"), nb::arg("values"), nb::arg("prior").none(),
           nb::arg("loop_and_map"))
      .def("trajectory",
           [](SlamRegistrar& slam) {
             const auto record = closed(slam);
             return std::pair(stamps_array(record->trajectory), poses_array(record->trajectory));
           })
      .def("odometry_trajectory",
           [](SlamRegistrar& slam) {
             const auto record = closed(slam);
             return std::pair(stamps_array(record->loops->odometry), poses_array(record->loops->odometry));
           })
      .def("save_places", &SlamRegistrar::save_places, nb::arg("folder"), Unlocked())
      .def("closures", [](SlamRegistrar& slam) { return closures_list(*closed(slam)->loops); })
      .def("keyframes", [](SlamRegistrar& slam) { return closed(slam)->loops->keyframe_scans; })
      .def("map", [](SlamRegistrar& slam) { return map_array(closed(slam)->map); })
      .def(
          "map_records", [](SlamRegistrar& slam) { return structured_array(closed(slam)->map.records()); },
          nb::sig("def map_records(self) -> numpy.typing.NDArray[numpy.void]"));
}

}  // namespace tilth::python

// tilth._tilth: what the package in python/tilth is made of. Users import tilth.
#include "bindings.hpp"
#include <tilth/core/error.hpp>

NB_MODULE(_tilth, module) {
  module.doc() = "The compiled part of the package tilth: import that.";
  nanobind::set_leak_warnings(false);  // a module that is imported lives as long as the interpreter
  nanobind::exception<tilth::Error>(module, "Error", PyExc_ValueError).attr("__doc__") =
      "Bad input: its text names the file, argument or option and the bound that it breaks.";
  module.attr("version") = TILTH_VERSION;
  tilth::python::add_scan(module);
  tilth::python::add_result(module);
  tilth::python::add_odometry(module);
  tilth::python::add_slam(module);
  tilth::python::add_localizer(module);
  tilth::python::add_sources(module);
  tilth::python::add_run(module);
  tilth::python::add_evaluation(module);
  tilth::python::add_registration(module);
  tilth::python::add_stages(module);
  tilth::python::add_files(module);
}

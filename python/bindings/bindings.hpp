// What each file adds to the module tilth._tilth.
#pragma once

#include <nanobind/nanobind.h>

namespace tilth::python {

namespace nb = nanobind;

void add_scan(nb::module_& module);
void add_result(nb::module_& module);
void add_odometry(nb::module_& module);
void add_slam(nb::module_& module);
void add_localizer(nb::module_& module);
void add_sources(nb::module_& module);
void add_run(nb::module_& module);
void add_evaluation(nb::module_& module);
void add_registration(nb::module_& module);
void add_stages(nb::module_& module);
void add_files(nb::module_& module);

}  // namespace tilth::python

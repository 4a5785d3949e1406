// Recordings and simulations, scan by scan.
#include <memory>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <tuple>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interrupt.hpp"
#include <tilth/sources/live_scans.hpp>
#include <tilth/sources/open_simulator.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::python {
namespace {

using SkippedRow = std::tuple<std::size_t, std::string, std::string>;

/// A source whose waiting Ctrl-C ends.
struct PythonSource {
  PythonSource() = default;
  PythonSource(PythonSource&&) = default;
  PythonSource& operator=(PythonSource&&) = delete;
  ~PythonSource() {
    if (interrupt) interrupt->stop();
  }

  std::unique_ptr<Interrupt> interrupt = std::make_unique<Interrupt>();  // which the source asks
  std::unique_ptr<ScanSource> source = nullptr;
  bool waits = false;  ///< for a sensor
};

PythonSource open_python_source(const std::string& uri, const std::string& topic, const std::string& frame, double rate,
                                const OptionValues& values) {
  PythonSource opened;
  Interrupt& interrupt = *opened.interrupt;
  opened.waits = is_live(uri);
  opened.source = interrupt.unlocked(opened.waits, [&] {
    return open_source(uri, {topic, frame, rate, values, [&interrupt] { return interrupt.came(); }});
  });
  return opened;
}

/// The next scan, read while other threads of Python run.
std::optional<Scan> next_of(PythonSource& self) {
  return self.interrupt->unlocked(self.waits, [&] { return self.source->next(); });
}

std::vector<SkippedRow> skipped_rows(const PythonSource& self) {
  std::vector<SkippedRow> rows;
  for (const SkippedScan& skipped : self.source->skipped())
    rows.emplace_back(skipped.index, skipped.where, skipped.what);
  return rows;
}

std::pair<Scan, ColumnArray<std::uint8_t>> simulated(const OpenedSimulator& opened, std::size_t index) {
  if (index >= opened.simulator->size()) throw nb::index_error("no such scan");
  LabelledScan scan;
  {
    const nb::gil_scoped_release unlocked;
    scan = opened.simulator->scan(index);
  }
  return {std::move(scan.scan), column_array(std::move(scan.labels))};
}

}  // namespace

void add_sources(nb::module_& module) {
  nb::class_<PythonSource>(module, "Source")
      .def("next", &next_of)
      .def("size", [](const PythonSource& self) { return self.source->size(); })
      .def("contents", [](const PythonSource& self) { return self.source->contents(); })
      .def("decisions", [](const PythonSource& self) { return self.source->decisions(); })
      .def("notices", [](const PythonSource& self) { return self.source->notices(); })
      .def("skipped", &skipped_rows);
  module.def("open_source", &open_python_source);

  nb::class_<OpenedSimulator>(module, "Simulator")
      .def("__init__", [](OpenedSimulator* self, const std::string& scene,
                          const OptionValues& values) { new (self) OpenedSimulator(open_simulator(scene, values)); })
      .def("size", [](const OpenedSimulator& opened) { return opened.simulator->size(); })
      .def("scan", &simulated)
      .def("warnings", [](const OpenedSimulator& opened) { return opened.warnings; })
      .def("truth", [](const OpenedSimulator& opened) {
        const Trajectory& truth = opened.simulator->truth();
        return std::pair(stamps_array(truth), poses_array(truth));
      });
}

}  // namespace tilth::python

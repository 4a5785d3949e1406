// tilth.run: a recording becomes a record, and files.
#include <map>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "names.hpp"
#include "records.hpp"
#include "run_request.hpp"
#include <tilth/run/base_frame.hpp>
#include <tilth/run/summary_json.hpp>
#include <tilth/run/track_record.hpp>
#include <tilth/sources/live_source.hpp>

namespace tilth::python {
namespace {

/// Tells a function of Python, or None, how far the run is; what it raises ends the run as Ctrl-C does.
class PythonObserver final : public RunObserver {
 public:
  PythonObserver(nb::object progress, Interrupt& interrupt) : progress_(std::move(progress)), interrupt_(interrupt) {}

  void progress(std::size_t scans, std::optional<std::size_t> total) override {
    if (progress_.is_none()) return;
    const nb::gil_scoped_acquire locked;
    try {
      progress_(scans, total);
    } catch (nb::python_error& error) {
      interrupt_.keep(error);
    }
  }

 private:
  nb::object progress_;
  Interrupt& interrupt_;
};

RunOutcome run_request(const RunRequest& request, nb::object progress) {
  Interrupt interrupt;
  PythonObserver observer(std::move(progress), interrupt);
  return interrupt.unlocked(request.source.starts_with(kLiveScheme),
                            [&] { return perform(request, observer, interrupt); });
}

template <class T, class F>
ColumnArray<T> column_by(const ScanTable& table, const F& of) {
  std::vector<T> values;
  values.reserve(table.rows.size());
  for (const ScanRow& row : table.rows) values.push_back(T(of(row)));
  return column_array(std::move(values));
}

NamedValues scan_columns(const RunOutcome& outcome) {
  using R = const ScanRow&;
  const ScanTable& table = outcome.record.scans;
  nb::dict columns;
  const auto count = [&](const char* name, const auto& of) { columns[name] = column_by<std::int64_t>(table, of); };
  const auto number = [&](const char* name, const auto& of) { columns[name] = column_by<double>(table, of); };
  number("stamp", [](R row) { return row.stamp; });
  count("points_read", [](R row) { return row.points_read; });
  count("points_in", [](R row) { return row.points_in; });
  count("outliers", [](R row) { return row.outliers; });
  count("edges", [](R row) { return row.edges; });
  count("planes", [](R row) { return row.planes; });
  count("candidates", [](R row) { return row.candidates; });
  count("matches", [](R row) { return row.matches; });
  count("iterations", [](R row) { return row.iterations; });
  count("converged", [](R row) { return row.converged; });
  number("weight", [](R row) { return row.weight; });
  number("error", [](R row) { return row.error; });
  count("degenerate_directions", [](R row) { return row.degenerate_directions; });
  number("read_ms", [](R row) { return row.read_ms; });
  number("register_ms", [](R row) { return row.register_ms; });
  number("register_cpu_ms", [](R row) { return row.register_cpu_ms; });
  number("map_ms", [](R row) { return row.map_ms; });
  nb::list track;
  for (const ScanRow& row : table.rows) track.append(name_of(row.track.state));
  columns["track"] = track;
  return nb::borrow<NamedValues>(columns);
}

std::pair<ColumnArray<double>, PosesArray> pair_of(const Trajectory& of_lidar, const RunRecord& record) {
  const Trajectory trajectory = poses_of_base(of_lidar, record.T_base_lidar);
  return {stamps_array(trajectory), poses_array(trajectory)};
}

std::vector<std::tuple<std::size_t, std::string, std::string>> skipped_of(const RunOutcome& outcome) {
  std::vector<std::tuple<std::size_t, std::string, std::string>> rows;
  for (const SkippedScan& skipped : outcome.record.skipped)
    rows.emplace_back(skipped.index, skipped.where, skipped.what);
  return rows;
}

void add_request(nb::module_& module) {
  nb::class_<RunRequest> request(module, "RunRequest");
  request.def(nb::init<>())
      .def_rw("source", &RunRequest::source)
      .def_rw("pipeline", &RunRequest::pipeline)
      .def_rw("out", &RunRequest::out)
      .def_rw("values", &RunRequest::values)
      .def_rw("loop", &RunRequest::loop)
      .def_rw("map", &RunRequest::map)
      .def_rw("output", &RunRequest::output)
      .def_rw("report", &RunRequest::report)
      .def_rw("beams", &RunRequest::beams)
      .def_rw("truth", &RunRequest::truth)
      .def_rw("calibration", &RunRequest::calibration)
      .def_rw("base_from_lidar", &RunRequest::base_from_lidar)
      .def_rw("max_scans", &RunRequest::max_scans)
      .def_rw("threads", &RunRequest::threads)
      .def_rw("loop_closure", &RunRequest::loop_closure)
      .def_rw("learn_beams", &RunRequest::learn_beams)
      .def_rw("strict", &RunRequest::strict)
      .def("read", [](RunRequest& self, const std::string& topic, const std::string& frame, double rate,
                      const OptionValues& values) {
        self.input = {topic, frame, rate, values};
      });
}

}  // namespace

void add_run(nb::module_& module) {
  using O = const RunOutcome&;
  add_request(module);
  nb::class_<RunOutcome>(module, "RunOutcome")
      .def_ro("failures", &RunOutcome::failures)
      .def("trajectory", [](O o) { return pair_of(o.record.trajectory, o.record); })
      .def("odometry",
           [](O o) { return pair_of(o.record.loops ? o.record.loops->odometry : o.record.trajectory, o.record); })
      .def("map", [](O o) { return map_array(o.record.map); })
      .def(
          "map_records", [](O o) { return structured_array(o.record.map.records()); },
          nb::sig("def map_records(self) -> numpy.typing.NDArray[numpy.void]"))
      .def("scans", &scan_columns)
      .def("closures", [](O o) { return o.record.loops ? closures_list(*o.record.loops) : NamedValuesList(); })
      .def("decisions", [](O o) { return o.record.decisions; })
      .def("notices", [](O o) { return o.record.notices; })
      .def("skipped", &skipped_of)
      .def("ended", [](O o) { return o.record.ended; })
      .def("loss", [](O o) { return loss_sentence(o.record.scans); })
      .def("summary", [](O o) { return summary_json(o.record); })
      .def("evaluation", [](O o) { return o.record.evaluation; });
  module.def("run", &run_request, nb::arg("request"), nb::arg("progress").none());
}

}  // namespace tilth::python

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
#include "interrupt.hpp"
#include "names.hpp"
#include "recording_run.hpp"
#include "records.hpp"
#include <tilth/run/base_frame.hpp>
#include <tilth/run/summary_json.hpp>
#include <tilth/run/track_record.hpp>
#include <tilth/sources/live_scans.hpp>

namespace tilth::python {
namespace {

using app::RecordingArguments;
using app::RunArguments;
using app::RunOutcome;

/// Tells functions of Python, each of which may be None, how far the run is and what happens; what they raise ends the
/// run as Ctrl-C does.
class PythonObserver final : public RunObserver {
 public:
  PythonObserver(nb::object progress, nb::object told, Interrupt& interrupt)
      : progress_(std::move(progress)), told_(std::move(told)), interrupt_(interrupt) {}

  void note(const std::string& text) override { tell(told_, text); }
  void warn(const std::string& text) override { tell(told_, text); }
  void progress(std::size_t scans, std::optional<std::size_t> total) override { tell(progress_, scans, total); }

 private:
  template <class... T>
  void tell(const nb::object& function, const T&... what) {
    if (function.is_none()) return;
    const nb::gil_scoped_acquire locked;
    try {
      function(what...);
    } catch (nb::python_error& error) {
      interrupt_.keep(error);
    }
  }

  nb::object progress_, told_;
  Interrupt& interrupt_;
};

RunOutcome run_recording(RecordingArguments arguments, nb::object progress, nb::object told) {
  Interrupt interrupt;
  PythonObserver observer(std::move(progress), std::move(told), interrupt);
  arguments.run.session.interrupted = [&interrupt] { return interrupt.came(); };
  return interrupt.unlocked(is_live(arguments.run.source),
                            [&] { return app::RecordingRun(arguments, observer).run(); });
}

/// Each value to the stage that has an option of its key; the files have what is left, and refuse what nobody has.
void set_outputs(RunArguments& run, const OptionValues& values) {
  run.output = values;
  const auto give = [&run](const std::vector<OptionInfo>& options, OptionValues& stage) {
    for (const OptionInfo& option : options)
      if (auto given = run.output.extract(option.key)) stage.insert(std::move(given));
  };
  give(describe(MapOptions{}), run.map);
  give(describe(ReportOptions{}), run.report);
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

void add_arguments(nb::module_& module) {
  nb::class_<app::OptionArguments>(module, "OptionArguments")
      .def_rw("pipeline", &app::OptionArguments::pipeline)
      .def_rw("config", &app::OptionArguments::config)
      .def_rw("settings", &app::OptionArguments::settings);
  nb::class_<RunArguments>(module, "RunArguments")
      .def_rw("source", &RunArguments::source)
      .def_rw("out", &RunArguments::out)
      .def_rw("options", &RunArguments::options)
      .def_rw("beams", &RunArguments::beams)
      .def_rw("prior", &RunArguments::prior)
      .def_rw("save_map", &RunArguments::save_map)
      .def_rw("map_to_continue", &RunArguments::map_to_continue)
      .def_rw("base_from_lidar", &RunArguments::base_from_lidar)
      .def_rw("threads", &RunArguments::threads)
      .def_rw("loop_closure", &RunArguments::loop_closure)
      .def_rw("learn_beams", &RunArguments::learn_beams)
      .def_rw("keep_beams", &RunArguments::keep_beams)
      .def_rw("level", &RunArguments::level)
      .def("set_session",
           [](RunArguments& self, std::size_t max_scans, bool strict) {
             self.session = {max_scans, strict, {}};
           })
      .def("set_view",
           [](RunArguments& self, const std::string& host, std::uint16_t port) {
             self.view = {host, port};
           })
      .def("set_outputs", &set_outputs);
  nb::class_<RecordingArguments>(module, "RecordingArguments")
      .def(nb::init<>())
      .def_rw("run", &RecordingArguments::run)
      .def_rw("truth", &RecordingArguments::truth)
      .def_rw("calibration", &RecordingArguments::calibration)
      .def("set_input", [](RecordingArguments& self, const std::string& topic, const std::string& frame, double rate,
                           const OptionValues& values) {
        self.input = {topic, frame, rate, values};
      });
}

}  // namespace

void add_run(nb::module_& module) {
  using O = const RunOutcome&;
  add_arguments(module);
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
  module.def("run", &run_recording, nb::arg("arguments"), nb::arg("progress").none(), nb::arg("told").none());
}

}  // namespace tilth::python

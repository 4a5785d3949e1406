#include <tilth/core/error.hpp>
#include <tilth/run/localization_run.hpp>
#include <tilth/run/machine.hpp>
#include <tilth/run/scan_row.hpp>
#include <tilth/run/skipped_scans.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth {
namespace {

std::string text_of(MapState state) {
  return std::string(names_of(state)[std::size_t(state)]);
}

HypothesisRow row_of(const PlaceFit& fit, const PlaceFit& best) {
  HypothesisRow row{.T_map_lidar = fit.T_map_lidar, .likeness = likeness_of(fit)};
  const PairedFit shares = paired(best, fit);
  row.against = shares.first, row.in_favour = shares.second;
  row.overlap = fit.overlap.ratio, row.landmarks = fit.overlap.landmarks, row.fitness = fit.overlap.fitness;
  row.through = fit.through, row.scale = fit.scale;
  row.degenerate_directions = fit.determined.degenerate_directions;
  return row;
}

/// Takes scans one by one.
class LocalizationLoop {
 public:
  LocalizationLoop(Localizer& localizer, RunObserver& observer, RunRecord& record,
                   std::span<const std::unique_ptr<Sink>> sinks)
      : localizer_(localizer), observer_(observer), record_(record), sinks_(sinks) {}

  void forget() {
    localizer_.forget();
    begins_ = true;
  }

  void add(const Scan& scan, double read_ms) {
    const Stopwatch stopwatch;
    const double cpu_before = thread_cpu_milliseconds();
    LocatedScan located = localizer_.add(scan);
    ScanRow row = row_of(scan, located.odometry);
    row.register_ms = stopwatch.milliseconds();
    row.register_cpu_ms = thread_cpu_milliseconds() - cpu_before;
    row.read_ms = read_ms;
    tell(located);
    keep(located, std::move(row));
    begins_ = false;
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->take(scan, located.odometry, record_);
  }

  bool is_found() const { return !begins_ && is_known(state_); }

 private:
  void tell(const LocatedScan& located) {
    if (located.state == state_ && !begins_) return;
    const std::string when = "at " + std::to_string(located.odometry.stamp) + " s: ";
    if (located.state == MapState::lost)
      observer_.warn(when + "the place in the map is lost");
    else if (state_ != MapState::lost || located.state != MapState::searching)
      observer_.note(when + text_of(located.state));
    state_ = located.state;
  }

  void keep(LocatedScan& located, ScanRow row) {
    LocalizationRow to{.stamp = located.odometry.stamp, .state = located.state, .T_map_lidar = located.T_map_lidar};
    to.covariance = located.covariance;
    to.overlap = located.overlap, to.through = located.through;
    to.milliseconds = row.register_ms, to.begun = begins_;
    for (const PlaceFit& fit : located.hypotheses) to.hypotheses.push_back(row_of(fit, located.hypotheses.front()));
    if (located.T_map_lidar) {
      row.covariance = located.covariance;
      record_.trajectory.push_back({to.stamp, *located.T_map_lidar});
      record_.scans.rows.push_back(std::move(row));
    }
    record_.localization->rows.push_back(std::move(to));
  }

  Localizer& localizer_;
  RunObserver& observer_;
  RunRecord& record_;
  std::span<const std::unique_ptr<Sink>> sinks_;
  MapState state_ = MapState::searching;
  bool begins_ = true;
};

/// The next scan; nothing at the end, and where the input breaks off, which the record then says.
std::optional<Scan> next_scan(ScanSource& source, std::size_t number, RunObserver& observer, RunRecord& record,
                              bool& broken) {
  const std::size_t before = source.skipped().size();
  std::optional<Scan> scan;
  try {
    scan = source.next();
  } catch (const std::exception& e) {
    keep_skipped({number, "input", e.what()}, observer, record);
    broken = true;
  }
  for (std::size_t i = before; i < source.skipped().size(); ++i) keep_skipped(source.skipped()[i], observer, record);
  return scan;
}

RunEnd run_through(ScanSource& source, const LocalizationRunOptions& options, LocalizationLoop& loop,
                   RunObserver& observer, RunRecord& record) {
  const SessionOptions& session = options.session;
  std::size_t since = 0;  // the last restart
  for (std::size_t read = 0; session.max_scans == 0 || read < session.max_scans; ++read, ++since) {
    if (session.interrupted && session.interrupted()) return RunEnd::interrupted;
    const Stopwatch reading;
    bool broken = false;
    const std::optional<Scan> scan = next_scan(source, read, observer, record, broken);
    if (session.strict && !source.skipped().empty()) return RunEnd::bad_record;
    if (!scan) return broken ? RunEnd::input_broken : RunEnd::end_of_input;
    if (read == 0) record.decisions = source.decisions();
    if ((since > 0 && since == options.restart_every) || (options.restart_when_found && loop.is_found())) {
      loop.forget();
      since = 0;
    }
    try {
      loop.add(*scan, reading.milliseconds());
    } catch (const UnusableScan& e) {
      keep_skipped({read, "scan " + std::to_string(read), e.what()}, observer, record);
      if (session.strict) return RunEnd::bad_record;
    }
    observer.progress(read + 1, source.size());
  }
  return RunEnd::max_scans;
}

}  // namespace

RunEnd localize(ScanSource& source, Localizer& localizer, const LocalizationRunOptions& options, RunObserver& observer,
                RunRecord& record) {
  const Stopwatch stopwatch;
  if (!record.localization) record.localization.emplace();
  for (const SkippedScan& skipped : source.skipped()) keep_skipped(skipped, observer, record);
  LocalizationLoop loop(localizer, observer, record, options.sinks);
  const RunEnd end = run_through(source, options, loop, observer, record);
  for (const std::string& decision : record.decisions) observer.note(decision);
  record.notices = source.notices();
  for (const std::string& notice : record.notices) observer.note(notice);
  if (const auto reason = reason_of_failure(*record.localization, localizer.options().find.max_scale_error)) {
    observer.warn(*reason);
    record.notices.push_back(*reason);
  }
  record.ended = to_text(end);
  record.wall_seconds = stopwatch.seconds();
  record.peak_megabytes = peak_megabytes();
  return end;
}

void show_map(const PlaceMap& map, RunRecord& record) {
  PointCloud cloud;
  for (std::size_t i = 0; i < map.places().size(); ++i) {
    for (const SurfacePatch& patch : map.patches(i)) cloud.points.push_back(map.places()[i].T_map_lidar * patch.mean);
  }
  record.map.add(cloud, Pose::Identity(), 0.0, {});
}

}  // namespace tilth

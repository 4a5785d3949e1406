#include "register_scans.hpp"

#include "interrupt.hpp"
#include "stopwatch.hpp"
#include <tilth/core/error.hpp>

namespace tilth::app {
namespace {

constexpr std::size_t kMostWarnings = 10;

ScanRow row_of(const Scan& scan, const OdometryResult& result) {
  ScanRow row;
  row.stamp = result.stamp;
  row.points_read = scan.cloud.size();
  row.points_in = result.counts.points_in;
  row.outliers = result.counts.outliers;
  row.edges = result.counts.edges;
  row.planes = result.counts.planes;
  row.candidates = result.alignment.candidates;
  row.matches = result.alignment.matches;
  row.iterations = result.alignment.iterations;
  row.converged = result.alignment.converged;
  row.error = result.alignment.error;
  row.degenerate_directions = result.alignment.degenerate_directions;
  row.variances = result.covariance.value_or(result.alignment.covariance).diagonal();
  return row;
}

}  // namespace

std::string to_text(RunEnd end) {
  switch (end) {
    case RunEnd::end_of_input: return "end of input";
    case RunEnd::max_scans: return "as many scans as asked for";
    case RunEnd::interrupted: return "interrupted";
    case RunEnd::bad_record: return "a record that cannot be used (--strict)";
    case RunEnd::input_broken: return "the input breaks off";
  }
  return {};
}

RegistrationLoop::RegistrationLoop(ScanSource& source, Odometry& odometry, RunRecord& record, Console& console)
    : source_(source), odometry_(odometry), record_(record), console_(console) {
  odometry_.listen([this](std::string_view stage) { clock_.begin(stage); });
}

RunEnd RegistrationLoop::run(const LoopOptions& options) {
  while (options.max_scans == 0 || read_ < options.max_scans) {
    if (interrupted() != 0) return RunEnd::interrupted;
    const Stopwatch reading;
    const std::optional<Scan> scan = read();
    if (options.strict && !record_.skipped.empty()) return RunEnd::bad_record;
    if (!scan) return broken_ ? RunEnd::input_broken : RunEnd::end_of_input;
    if (read_++ == 0) {
      record_.decisions = source_.decisions();
      for (const std::string& decision : record_.decisions) console_.note(decision);
    }
    const bool registered = register_scan(*scan, reading.milliseconds());
    if (!registered && options.strict) return RunEnd::bad_record;
    if (registered && options.registered) options.registered();
    console_.progress(read_, source_.size());
  }
  return RunEnd::max_scans;
}

std::optional<Scan> RegistrationLoop::read() {
  try {
    std::optional<Scan> scan = source_.next();
    take_skipped();
    return scan;
  } catch (const std::exception& e) {
    take_skipped();
    skip({read_ + taken_, "input", e.what()});
    broken_ = true;
    return std::nullopt;
  }
}

bool RegistrationLoop::register_scan(const Scan& scan, double read_ms) {
  try {
    const double cpu_before = thread_cpu_milliseconds();
    clock_.start();
    const OdometryResult result = odometry_.register_scan(scan);
    ScanRow row = row_of(scan, result);
    row.register_ms = clock_.stop();
    row.register_cpu_ms = thread_cpu_milliseconds() - cpu_before;
    row.stage_ms = clock_.milliseconds();
    row.read_ms = read_ms;
    keep(scan, result, std::move(row));
    return true;
  } catch (const Error& e) {
    skip({read_ - 1 + taken_, "scan " + std::to_string(read_ - 1 + taken_), e.what()});
    return false;
  }
}

void RegistrationLoop::keep(const Scan& scan, const OdometryResult& result, ScanRow row) {
  if (record_.mcap) record_.mcap->add_scan(result.filtered, {result.stamp, result.stamp - scan.stamp, result.motion});
  const Stopwatch mapping;
  record_.map.add(result.filtered, result.T_world_lidar, result.stamp - scan.stamp, result.motion);
  row.map_ms = mapping.milliseconds();
  record_.trajectory.push_back({result.stamp, result.T_world_lidar});
  record_.scans.stages = clock_.stages();
  record_.scans.rows.push_back(std::move(row));
}

void RegistrationLoop::take_skipped() {
  for (; taken_ < source_.skipped().size(); ++taken_) {
    const SkippedScan& s = source_.skipped()[taken_];
    skip({s.index, s.where, s.what});
  }
}

void RegistrationLoop::skip(SkippedRecord skipped) {
  if (record_.skipped.size() < kMostWarnings) console_.warn("skipped: " + skipped.where + ": " + skipped.what);
  if (record_.skipped.size() == kMostWarnings) console_.warn("more was skipped; all of it stands in summary.json");
  record_.skipped.push_back(std::move(skipped));
}

}  // namespace tilth::app

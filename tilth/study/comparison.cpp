#include <algorithm>
#include <limits>

#include <tilth/study/comparison.hpp>

namespace tilth {
namespace {

/// Adds the numbers of one run to a sum.
void add(const RunOutcome& run, RunOutcome& sum) {
  sum.path += run.path;
  sum.ape_rotation += run.ape_rotation;
  sum.rpe += run.rpe;
  sum.rpe_rotation += run.rpe_rotation;
  sum.end_drift += run.end_drift;
  sum.cpu_ms += run.cpu_ms;
  sum.cpu_ms_p99 += run.cpu_ms_p99;
  sum.peak_megabytes += run.peak_megabytes;
}

void divide(RunOutcome& sum, double count) {
  for (double* number : {&sum.path, &sum.ape_rotation, &sum.rpe, &sum.rpe_rotation, &sum.end_drift, &sum.cpu_ms,
                         &sum.cpu_ms_p99, &sum.peak_megabytes}) {
    *number /= count;
  }
}

MethodSummary& entry_of(const RunLabel& label, std::vector<MethodSummary>& all) {
  for (MethodSummary& entry : all) {
    if (entry.source == label.source && entry.method == label.method) return entry;
  }
  all.push_back({});
  all.back().source = label.source;
  all.back().method = label.method;
  return all.back();
}

void take(const RunOutcome& run, MethodSummary& entry) {
  ++entry.runs;
  if (!run.failure.empty()) ++entry.failed;
  if (run.ape.empty()) return;
  ++entry.judged;
  entry.ape.errors.insert(entry.ape.errors.end(), run.ape.begin(), run.ape.end());
  entry.worst_rmse = std::max(entry.worst_rmse, metric_of(run.ape).rmse);
  entry.worst_drift = std::max(entry.worst_drift, run.end_drift);
  add(run, entry.mean);
  if (!run.consistency) return;
  ++entry.with_nees;
  entry.mean_nees += run.consistency->mean_nees;
}

}  // namespace

std::vector<MethodSummary> summarize(std::span<const RunOutcome> runs) {
  std::vector<MethodSummary> all;
  for (const RunOutcome& run : runs) take(run, entry_of(run.label, all));
  for (MethodSummary& entry : all) {
    if (entry.judged == 0) continue;
    entry.ape = metric_of(std::move(entry.ape.errors));
    divide(entry.mean, double(entry.judged));
    if (entry.with_nees > 0) entry.mean_nees /= double(entry.with_nees);
  }
  return all;
}

double improvement(double mean, double base_mean) {
  if (base_mean == 0) return mean == 0 ? 0 : -std::numeric_limits<double>::infinity();
  return 100 * (1 - mean / base_mean);
}

}  // namespace tilth

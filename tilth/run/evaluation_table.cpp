#include <cstdarg>
#include <cstdio>
#include <numbers>

#include <tilth/run/evaluation_report.hpp>

namespace tilth {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian
constexpr double kElsewhereDistance = 0.1;           // [m] and
constexpr double kElsewhereAngle = 1.0;              // [deg] from which on a start is said to lie elsewhere

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[256];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return std::string(text) + "\n";
}

std::string row(const char* name, const Metric& m) {
  return line("%-22s %11.6f %11.6f %11.6f %11.6f %11.6f %11.6f %13.6f", name, m.rmse, m.mean, m.median, m.std, m.min,
              m.max, m.sse);
}

std::string rows(const std::string& measure, const PoseErrors& errors) {
  return row((measure + " translation [m]").c_str(), errors.translation) +
         row((measure + " rotation [deg]").c_str(), scaled(errors.rotation, kDegrees)) +
         row((measure + " full [-]").c_str(), errors.full);
}

std::string head(const Evaluation& e) {
  const PairOptions& pairs = e.options.rpe.pairs;
  return line("%zu matching poses of %zu (truth) and %zu (estimate); alignment: %s", e.matches.truth.size(),
              e.truth_poses, e.estimate_poses, kAlignmentNames[std::size_t(e.options.align)].data()) +
         line("the truth's path is %.3f m long, the estimate's %.3f m", path_length(e.matches.truth),
              path_length(e.matches.estimate)) +
         line("RPE over %zu pairs %g %s apart, %s", e.rpe.translation.errors.size(), pairs.delta,
              kDeltaUnitNames[std::size_t(pairs.unit)].data(), pairs.all_pairs ? "from every pose" : "end to end");
}

std::string kitti_rows(const KittiMetric& metric) {
  std::string text = line("\n%-22s %11s %11s", "KITTI segments", "[%]", "[deg/m]");
  for (const SegmentError& mean : metric.by_length) {
    text += line("%6g m %14s %11.6f %11.6f", mean.length, "", 100 * mean.translation, kDegrees * mean.rotation);
  }
  return text + line("mean of %-14zu %11.6f %11.6f", metric.segments.size(), 100 * metric.translation,
                     kDegrees * metric.rotation);
}

std::string hint(const Evaluation& e) {
  const double angle = kDegrees * e.start_angle;
  if (e.options.align != Alignment::none) return "";
  if (e.start_distance < kElsewhereDistance && angle < kElsewhereAngle) return "";
  return line(
      "\nhint: the estimate starts %.3f m and %.3f deg away from the truth. Where the two are given in "
      "different frames, ask for --align se3 or --align origin.",
      e.start_distance, angle);
}

}  // namespace

std::string evaluation_table(const Evaluation& evaluation) {
  std::string text;
  for (const std::string& notice : notices_of(evaluation)) text += notice + "\n";
  text += head(evaluation) + "\n";
  text += line("%-22s %11s %11s %11s %11s %11s %11s %13s", "", "rmse", "mean", "median", "std", "min", "max", "sse");
  text += rows("APE", evaluation.ape) + rows("RPE", evaluation.rpe);
  if (evaluation.kitti) text += kitti_rows(*evaluation.kitti);
  return text + hint(evaluation);
}

}  // namespace tilth

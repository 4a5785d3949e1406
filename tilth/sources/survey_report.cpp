#include <algorithm>
#include <cstdio>

#include <tilth/sources/scan_survey.hpp>

namespace tilth {
namespace {

constexpr double kNear = 1.0;                      ///< [m]
constexpr double kManyNear = 0.3;                  ///< of the points
constexpr double kSlowest = 4.0, kFastest = 25.0;  ///< [Hz] of usual sensors
constexpr double kOverlapping = 1.5;               ///< times the step that a scan's own times span
constexpr double kFewPoints = 2000.0;              ///< a scan
constexpr std::size_t kMostGaps = 5;               ///< named one by one
constexpr int kBarWidth = 40;

template <class... A>
std::string text(const char* format, A... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

void add_bars(const SurveyHistogram& histogram, const std::string& unit, std::vector<std::string>& lines) {
  const std::size_t most =
      std::max<std::size_t>(1, *std::max_element(histogram.counts.begin(), histogram.counts.end()));
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const bool last = i + 1 == histogram.counts.size();
    const std::string upper = last ? std::string("     ") : text("%5g", histogram.borders[i + 1]);
    const int bar = int(double(kBarWidth) * double(histogram.counts[i]) / double(most) + 0.5);
    lines.push_back(text("  %6g .. %s %s %10zu  %s", histogram.borders[i], upper.c_str(), unit.c_str(),
                         histogram.counts[i], std::string(std::size_t(bar), '#').c_str()));
  }
}

std::size_t beams_with_points(const ScanSurvey& survey) {
  const auto& counts = survey.points_on_rings();
  return std::size_t(std::count_if(counts.begin(), counts.end(), [](std::size_t n) { return n > 0; }));
}

void warn_of_time(const ScanSurvey& survey, std::vector<std::string>& warnings) {
  if (survey.scans_with_times() == 0) {
    warnings.emplace_back(
        "The points have no times of their own. While the sensor moves, a scan is bent by the motion, and that cannot "
        "be "
        "undone: drive slowly, or record with a driver that writes a time for every point.");
  }
  const std::vector<Gap> gaps = survey.gaps();
  for (std::size_t i = 0; i < std::min(gaps.size(), kMostGaps); ++i) {
    warnings.push_back(
        text("Scans are missing: %.2f s pass after scan %zu. Where the sensor moved far meanwhile, the "
             "trajectory may break there.",
             gaps[i].seconds, gaps[i].before));
  }
  if (gaps.size() > kMostGaps) warnings.push_back(text("%zu more such gaps follow.", gaps.size() - kMostGaps));
  const double rate = survey.step() > 0.0 ? 1.0 / survey.step() : 0.0;
  if (rate > 0.0 && survey.turn() > kOverlapping * survey.step()) {
    warnings.push_back(
        text("The points of a scan span %.3f s, but scans come every %.3f s: stamps and times of points do not run at "
             "the same speed, or scans overlap. Poses have the times of the stamps.",
             survey.turn(), survey.step()));
  }
  if (rate > 0.0 && (rate < kSlowest || rate > kFastest)) {
    warnings.push_back(
        text("%.1f scans a second are unusual (sensors turn 5 to 20 times). Were scans left out or cut "
             "apart when the recording was made?",
             rate));
  }
}

void warn_of_points(const ScanSurvey& survey, std::vector<std::string>& warnings) {
  if (survey.scans_with_rings() == 0)
    warnings.emplace_back(
        "It is not known which beam measured a point. Pipelines that need it refuse such a recording.");
  const double mean = double(survey.points()) / double(survey.scans());
  if (mean < kFewPoints)
    warnings.push_back(
        text("Only %.0f points a scan: a 16-beam sensor gives 10,000 to 29,000. Is most of the view open "
             "sky, or was the recording thinned out?",
             mean));
  if (const double ratio = survey.ratio_nearer(kNear); ratio > kManyNear) {
    warnings.push_back(
        text("%.0f %% of the points lie nearer than %g m. Probably the sensor sees the robot itself: leave "
             "these points out by a larger min_range.",
             100.0 * ratio, kNear));
  }
  if (survey.intensities_alike())
    warnings.emplace_back("All intensities are alike, so they say nothing about surfaces. Mapping does not need them.");
}

}  // namespace

std::vector<std::string> survey_lines(const ScanSurvey& survey) {
  std::vector<std::string> lines;
  const double scans = double(std::max<std::size_t>(1, survey.scans()));
  lines.push_back(
      text("scans: %zu over %.3f s from stamp %.6f", survey.scans(), survey.duration(), survey.first_stamp()));
  if (survey.step() > 0.0) lines.push_back(text("rate: %.2f scans a second", 1.0 / survey.step()));
  lines.push_back(text("gaps: %zu", survey.gaps().size()));
  lines.push_back(text("points: %.0f a scan (%zu to %zu), %zu in all", double(survey.points()) / scans,
                       survey.fewest_points(), survey.most_points(), survey.points()));
  lines.push_back(survey.scans_with_rings() == 0 ? "beams: not known" : text("beams: %zu", beams_with_points(survey)));
  lines.push_back(survey.scans_with_times() == 0 ? "times: none"
                                                 : text("times: 0 to %.4f s within a scan, in %zu scans", survey.turn(),
                                                        survey.scans_with_times()));
  lines.emplace_back("ranges [m]:");
  add_bars(survey.ranges(), "m", lines);
  if (!survey.intensities()) {
    lines.emplace_back("intensities: none");
    return lines;
  }
  lines.emplace_back("intensities:");
  add_bars(*survey.intensities(), " ", lines);
  return lines;
}

std::vector<std::string> survey_warnings(const ScanSurvey& survey) {
  std::vector<std::string> warnings;
  if (survey.scans() == 0) return {"There is not one scan in it that can be used."};
  if (survey.scans() == 1) warnings.emplace_back("There is only one scan: nothing moves, so there is nothing to map.");
  warn_of_time(survey, warnings);
  warn_of_points(survey, warnings);
  return warnings;
}

}  // namespace tilth

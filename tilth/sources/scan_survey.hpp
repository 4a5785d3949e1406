// What a recording holds, counted scan by scan, and what a newcomer should know about it before mapping it. O(1)
// memory beside one number a scan.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tilth/core/scan.hpp>

namespace tilth {

struct SurveyHistogram {
  std::vector<double> borders;  ///< ascending, one more than counts; the last bin takes what lies above
  std::vector<std::size_t> counts;
  void add(double value);
};

struct Gap {
  std::size_t before = 0;  ///< index of the scan after which it lies
  double seconds = 0.0;
};

class ScanSurvey {
 public:
  /// Ranges, intensities and beams are those of one in `every` points.
  explicit ScanSurvey(std::size_t every = 1) : every_(every) {}

  void add(const Scan& scan);

  std::size_t scans() const { return stamps_.size(); }
  std::size_t points() const { return points_; }
  std::size_t fewest_points() const { return fewest_; }
  std::size_t most_points() const { return most_; }
  double duration() const;        ///< [s] from the first stamp to the last
  double step() const;            ///< [s] from scan to scan, the median; 0 below two scans
  std::vector<Gap> gaps() const;  ///< steps of more than one and a half times the median
  double turn() const { return scans_with_times_ > 0 ? longest_turn_ : 0.0; }  ///< [s] of point times, at most
  std::size_t scans_with_times() const { return scans_with_times_; }
  std::size_t scans_with_rings() const { return scans_with_rings_; }
  const std::vector<std::size_t>& points_on_rings() const { return ring_counts_; }
  double first_stamp() const { return stamps_.empty() ? 0.0 : stamps_.front(); }
  double ratio_nearer(double range) const;                   ///< of the points; `range` is a border of ranges()
  const SurveyHistogram& ranges() const { return ranges_; }  ///< [m]
  const std::optional<SurveyHistogram>& intensities() const { return intensities_; }
  bool intensities_alike() const { return intensities_ && least_intensity_ == most_intensity_; }

 private:
  std::size_t every_;
  std::vector<double> stamps_;
  std::size_t points_ = 0, fewest_ = 0, most_ = 0, scans_with_times_ = 0, scans_with_rings_ = 0;
  double longest_turn_ = 0.0;
  std::vector<std::size_t> ring_counts_;
  SurveyHistogram ranges_{{0, 0.5, 1, 2, 5, 10, 20, 50, 100, 200}, std::vector<std::size_t>(9, 0)};
  std::optional<SurveyHistogram> intensities_;
  float least_intensity_ = 0.0F, most_intensity_ = 0.0F;
};

/// Counts and histograms as text, one line an entry.
std::vector<std::string> survey_lines(const ScanSurvey& survey);

/// What may go wrong with such a recording and what helps, one plain sentence or two each.
std::vector<std::string> survey_warnings(const ScanSurvey& survey);

}  // namespace tilth

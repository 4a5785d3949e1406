// What localisation made of each scan: localization.csv and hypotheses.csv. docs/localization.md describes every
// column.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tilth/core/se3.hpp>
#include <tilth/localization/map_state.hpp>

namespace tilth {

/// A place that a scan may have been taken at.
struct HypothesisRow {
  Pose T_map_lidar = Pose::Identity();
  double likeness = 0.0;                  ///< [-] how well it fits in all, 1 at best
  double against = 0.0, in_favour = 0.0;  ///< [-] shares of patches that fit better at the best pose, and at this
  double overlap = 0.0, landmarks = 0.0;  ///< [-]
  double fitness = 0.0;                   ///< [m]
  double through = 0.0;                   ///< [-]
  std::optional<double> scale = {};       ///< [-] the map's size over that of the scans, where it was asked for
  int degenerate_directions = 0;
};

struct LocalizationRow {
  double stamp = 0.0;  ///< [s]
  MapState state = MapState::searching;
  std::optional<Pose> T_map_lidar = {};
  Matrix6d covariance = Matrix6d::Zero();      ///< [rad^2, m^2]
  double overlap = 0.0, through = 0.0;         ///< [-]
  double milliseconds = 0.0;                   ///< [ms] that the scan took
  bool begun = false;                          ///< nothing was known before this scan
  std::vector<HypothesisRow> hypotheses = {};  ///< of a search at this scan, best first
};

struct LocalizationRecord {
  std::string map;  ///< its folder
  std::vector<LocalizationRow> rows = {};
};

/// Scans in a row in one state.
struct MapStateInterval {
  MapState state = MapState::searching;
  double from = 0.0, to = 0.0;  ///< [s]
  std::size_t scans = 0;
};
std::vector<MapStateInterval> state_intervals(const LocalizationRecord& record);

/// [s] from each beginning, and each loss, to the first scan that was located, where there was one.
std::vector<double> times_to_answer(const LocalizationRecord& record);

/// Why nothing was found, where one reason runs through the searches: a sentence, or nothing. `max_scale_error` is that
/// of the searches.
std::optional<std::string> reason_of_failure(const LocalizationRecord& record, double max_scale_error);

/// localization.csv, lines with their ends; poses are of base_link where it is known how the LiDAR is mounted.
std::string localization_header();
std::string localization_line(const LocalizationRow& row, const std::optional<Pose>& T_base_lidar);

/// Throws Error where the file cannot be written in full.
void write_hypotheses(const std::filesystem::path& path, const LocalizationRecord& record,
                      const std::optional<Pose>& T_base_lidar);

}  // namespace tilth

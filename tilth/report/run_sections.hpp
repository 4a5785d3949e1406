// The sections of a run's report, each from the record alone. O(scans).
#pragma once

#include <optional>

#include <tilth/report/judged_run.hpp>
#include <tilth/report/report.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

/// The name of the trajectory that loop closure corrected.
inline constexpr const char* kBeforeLoops = "before loop closure";

/// The way from above, roll, pitch, yaw, speed and height over time; with the truth where it is known,
/// and with loop closure also the way before it, keyframes and accepted closures.
Section path_section(const RunRecord& record, const std::optional<JudgedRun>& judged);

/// APE over time with its statistics, along the way, as a distribution; RPE; the tables.
Section accuracy_section(const RunRecord& record, const JudgedRun& judged);

/// Time of each stage, scan by scan and as distributions.
Section time_section(const RunRecord& record);

/// What the map and the track tell of the map's quality, without truth.
Section quality_section(const RunRecord& record);

/// What left or came while the map was made.
Section changes_section(const RunRecord& record);

/// Points, outliers, features, matches, iterations.
Section registration_section(const RunRecord& record);

/// Degenerate directions and standard deviations of the pose.
Section confidence_section(const RunRecord& record);

/// What the drive shows of each beam: its errors, and how long it reads about the planes of the map.
Section beams_section(const BeamCalibration& found);

/// What was run on what: options that differ from the defaults, input, version, machine.
Section setup_section(const RunRecord& record);

/// The numbers 0, 1, ... of an axis that counts in `bins` equal bins, and how many of `values` fall in each.
Curve histogram_of(const std::vector<float>& values, std::size_t bins);

}  // namespace tilth

// What became of each scan, one row a scan: scans.csv, whose columns docs/outputs.md describes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tilth/core/se3.hpp>
#include <tilth/core/track_state.hpp>

namespace tilth {

struct ScanRow {
  double stamp = 0.0;           ///< [s]
  std::size_t points_read = 0;  ///< as the source gave them
  std::size_t points_in = 0, outliers = 0, edges = 0, planes = 0;
  std::size_t candidates = 0, matches = 0;
  int iterations = 0;
  bool converged = false;
  double weight = 0.0;  ///< of the matches, by the robust kernel
  double error = 0.0;
  int degenerate_directions = 0;
  Track track;
  Matrix6d covariance = Matrix6d::Zero();  ///< [rad^2, m^2] of the LiDAR's pose, in its own frame
  double read_ms = 0.0, register_ms = 0.0, map_ms = 0.0;
  double register_cpu_ms = 0.0;  ///< [ms] CPU time of the thread that registers: with one thread, of all the work
  std::vector<double> stage_ms;  ///< of register_ms, by ScanTable::stages; stages not named take no time
};

struct ScanTable {
  std::vector<std::string> stages;  ///< of the pipeline, in the order of their first appearance
  std::vector<ScanRow> rows;
};

/// Throws Error where the file cannot be written in full.
/// Lines of scans.csv, with their ends.
std::string scan_table_header(const std::vector<std::string>& stages);
std::string scan_table_row(const ScanRow& row, std::size_t index, std::size_t stages);

void write_scan_table(const std::filesystem::path& path, const ScanTable& table);

}  // namespace tilth

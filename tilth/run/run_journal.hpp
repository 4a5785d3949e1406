// A run that is saved while it goes on: a line for every pose at once, map and summary from time to time in the
// background. Whenever the program ends, the folder holds a run that can be continued.
#pragma once

#include <filesystem>
#include <future>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <tilth/io/append_file.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {

/// The folder holds the poses of an earlier run.
bool holds_run(const std::filesystem::path& folder);

/// Puts the poses and the map of the run in `folder` into `record`, which has none yet; what was noticed, one sentence
/// each. Throws Error where its files cannot be read.
std::vector<std::string> continue_run(const std::filesystem::path& folder, RunRecord& record);

class RunJournal {
 public:
  /// Goes on with the files in `folder`, or, anew, takes those of an earlier run away: `files` by name. Throws Error
  /// where that fails.
  RunJournal(const std::filesystem::path& folder, std::span<const std::string> files, bool anew);
  ~RunJournal();
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;

  /// Writes the last pose and row of `record`. Throws Error where the disk is full, the stamp does not lie after that
  /// of the pose before, or the folder's scans.csv has other columns.
  void append(const RunRecord& record);

  /// Begins to write map.pcd and summary.json from a copy, unless the last time is not over yet. What went wrong then,
  /// or nothing.
  std::string checkpoint(const RunRecord& record);

  /// Waits for the last checkpoint and writes the map. What went wrong, one sentence a file.
  std::vector<std::string> finish(const RunRecord& record);

  /// What stands in the folder already and is not to be written again.
  static std::set<std::string> kept(const RunRecord& record);

 private:
  std::filesystem::path folder_;
  AppendFile poses_, rows_;
  bool columns_known_ = false;
  std::future<std::string> saving_;
};

}  // namespace tilth

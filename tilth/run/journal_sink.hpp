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
#include <tilth/run/run_observer.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/sink.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth {

/// The folder holds the poses of an earlier run.
bool holds_run(const std::filesystem::path& folder);

/// Puts the poses and the map of the run in `folder` into `record`, which has none yet; what was noticed, one sentence
/// each. Throws Error where its files cannot be read.
std::vector<std::string> continue_run(const std::filesystem::path& folder, RunRecord& record);

/// Takes the files of an earlier run away: those of the journal, and `files` by name.
void remove_run(const std::filesystem::path& folder, std::span<const std::string> files);

/// The files that a journal leaves complete; of a run with loop closure its poses are not those that were appended.
std::set<std::string> journal_files(bool loop_closure);

class JournalSink final : public Sink {
 public:
  /// Goes on with the files in `folder`, or begins them; [s] from one saving of the map to the next. Problems and
  /// progress go to `observer`, which must outlive this. Throws Error where the files cannot be opened.
  JournalSink(const std::filesystem::path& folder, double checkpoint_seconds, RunObserver& observer);
  ~JournalSink() override;
  JournalSink(const JournalSink&) = delete;
  JournalSink& operator=(const JournalSink&) = delete;

  /// Writes the last pose and row of `record`. Throws Error where the disk is full, the stamp does not lie after that
  /// of the pose before, or the folder's scans.csv has other columns.
  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;

  /// Waits for the last checkpoint and writes the map.
  void finish(const RunRecord& record) override;

 private:
  void append(const RunRecord& record);
  std::string checkpoint(const RunRecord& record);

  std::filesystem::path folder_;
  double checkpoint_seconds_;
  RunObserver& observer_;
  AppendFile poses_, rows_;
  bool columns_known_ = false;
  Stopwatch since_checkpoint_;
  std::future<std::string> saving_;
};

}  // namespace tilth

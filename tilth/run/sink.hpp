// What takes the results of a run: as each scan is registered, and when the run is over. A new output of a run is a
// sink of its own, and its line in report/run_outputs.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tilth {

struct OdometryResult;
struct RunRecord;
struct Scan;

class Sink {
 public:
  virtual ~Sink() = default;

  /// `scan` was registered with `result`: the last pose and row of `record`. Throws Error where the run must not go on.
  virtual void take(const Scan& scan, const OdometryResult& result, const RunRecord& record);

  /// The run is over, `record` stays as it is. Throws Error naming what could not be written.
  virtual void finish(const RunRecord& record) = 0;
};

/// Finishes all of them; one that fails does not keep the others from it. What went wrong, one sentence a sink.
[[nodiscard]] std::vector<std::string> finish_all(std::span<const std::unique_ptr<Sink>> sinks,
                                                  const RunRecord& record);

/// A file that is written when the run is over, by `write`.
std::unique_ptr<Sink> file_sink(std::filesystem::path path,
                                std::function<void(const std::filesystem::path& path, const RunRecord& record)> write);

}  // namespace tilth

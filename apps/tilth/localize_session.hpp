// What `tilth localize` and `tilth live --map` share: scans of whatever source, located in a saved map.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console.hpp"
#include "run_session.hpp"
#include <tilth/sources/scan_source.hpp>

namespace tilth::app {

struct LocalizeArguments {
  RunArguments run;
  std::string map;         ///< its folder
  std::vector<double> at;  ///< x, y, z [m], yaw [deg]; empty: not known
  std::size_t restart_every = 0;
  bool restart_when_found = false;
};

/// Adds --at.
CLI::Option* add_at_flag(CLI::App& command, LocalizeArguments& arguments);

/// The localisation that is asked for, before its first scan. Throws Error on an option that is wrong, and where the
/// map cannot be read.
class LocalizeSession {
 public:
  explicit LocalizeSession(const LocalizeArguments& arguments);
  ~LocalizeSession();

  /// The files that it writes.
  const std::vector<std::string>& files() const { return files_; }

  struct End {
    RunEnd end;
    bool whole;     ///< every file is written
    bool is_known;  ///< the place in the map, when it ended
  };

  /// Locates what `source` has and writes every file into the folder, which is locked by the caller; `observer` hears
  /// what happens.
  End run(std::unique_ptr<ScanSource> source, RunObserver& observer, Console& console);

 private:
  struct Plan;
  const LocalizeArguments& arguments_;
  std::unique_ptr<Plan> plan_;
  std::vector<std::string> files_;
};

}  // namespace tilth::app

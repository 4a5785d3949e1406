// Jobs done several at once, with progress and time left; interrupted, they stop and can be gone on with.
#pragma once

#include <string>
#include <vector>

#include "console.hpp"
#include "job.hpp"

namespace tilth::app {

struct QueueOptions {
  int at_once = 0;               ///< zero: as many as there are processors
  bool keep_recordings = false;  ///< scans made for the jobs stay when the last one is done
};

/// Does the jobs that are not done yet, in their order. Throws Error where files cannot be written. On Ctrl-C or
/// SIGTERM the running ones are ended and the rest is left.
void perform_all(const std::vector<Job>& jobs, const QueueOptions& options, Console& console);

/// Removes the scans that no job waits for any more.
void remove_finished_recordings(const std::vector<Job>& jobs);

}  // namespace tilth::app

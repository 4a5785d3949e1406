// Jobs handed to an engine that spreads them over machines: as lines of a shell, or to Dask by
// scripts/run_jobs_dask.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "job.hpp"

namespace tilth::app {

/// `tilth job FOLDER` with the path of this program, as a shell takes it.
std::string job_line(const Job& job);

struct DaskOptions {
  std::string python;          ///< interpreter that has dask and distributed
  std::string scheduler;       ///< address
  std::filesystem::path list;  ///< file to hand the commands over in
};

/// Has the jobs that are not done yet done by the workers of a scheduler, which must see the folders and this program.
/// Throws Error where there is no scheduler, or it gives up.
void perform_on_dask(const std::vector<Job>& jobs, const DaskOptions& options);

/// A file of scripts/: beside the installed program, else where this was built. Throws Error where it is missing.
std::filesystem::path script_file(const std::string& name);

}  // namespace tilth::app

// The files of a run by their names, and what writes each. docs/outputs.md describes them.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tilth/report/report_sink.hpp>
#include <tilth/run/output_options.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

struct RunOutput {
  std::string file;  ///< its name in the folder of the run
  std::function<std::unique_ptr<Sink>(const std::filesystem::path& path)> open;
};

/// Every file that the options ask for, with loop closure or without; where moving points stay in the map there is no
/// file of them. Throws Error as map_formats.
std::vector<RunOutput> run_outputs(const OutputOptions& options, const ReportOptions& report, bool loop_closure,
                                   bool keep_moving = false);

}  // namespace tilth

// The folder that a run writes into.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace tilth {

/// Makes `folder` where it is missing and makes sure that `files` can be written in it, before hours of work depend on
/// that. Files of an earlier run stay as they are. Throws Error naming what cannot be written, and why.
void prepare_output_folder(const std::filesystem::path& folder, std::span<const std::string> files);

}  // namespace tilth

// Option values from YAML: nested maps or dotted keys become "a.b" -> text. O(bytes).
#pragma once

#include <filesystem>
#include <string>

#include <tilth/core/options.hpp>

namespace tilth {

/// Throws Error naming file, line and key: broken YAML, a sequence, a key without value or given twice.
OptionValues read_config(const std::filesystem::path& path);
OptionValues parse_config(const std::string& text, const std::string& name);

}  // namespace tilth

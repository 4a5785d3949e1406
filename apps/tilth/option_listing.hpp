// The options of a pipeline as text: a table for people, YAML for `--config`, Markdown for docs/options.md.
#pragma once

#include <span>
#include <string>

#include <tilth/core/options.hpp>

namespace tilth::app {

/// What is advanced stands last, under a heading of its own; in YAML everything stands where its stage does.
std::string option_table(const std::string& pipeline, std::span<const OptionInfo> options);
std::string option_yaml(const std::string& pipeline, std::span<const OptionInfo> options);
std::string option_markdown(const std::string& pipeline, std::span<const OptionInfo> options);

}  // namespace tilth::app

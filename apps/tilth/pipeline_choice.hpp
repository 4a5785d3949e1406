// A pipeline and its options, as a file and settings choose them.
#pragma once

#include <string>
#include <vector>

#include <tilth/core/options.hpp>

namespace tilth::app {

struct OptionArguments {
  std::string pipeline;               ///< empty: what the file names, else the default
  std::string config;                 ///< YAML file; empty: none
  std::vector<std::string> settings;  ///< "key=value", stronger than the file
};

struct PipelineChoice {
  std::string name;
  OptionValues values;
  OptionValues loop;      ///< those that begin with "loop.", which are the same for every pipeline
  OptionValues localize;  ///< those that begin with "localize.", likewise
};

/// What "key=value" says, the last one of a key. Throws Error on what is no key=value.
OptionValues parse_settings(const std::vector<std::string>& settings);

/// A configuration file may name its pipeline (`pipeline: improved_floam`); the command line is stronger. Throws Error
/// on a file that cannot be read and on a setting that is no key=value. Keys and bounds are checked by the pipeline.
PipelineChoice choose_pipeline(const OptionArguments& arguments);

}  // namespace tilth::app

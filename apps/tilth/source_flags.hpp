// What the command line says of SOURCE: the flags of `tilth run`, `info` and `convert`.
#pragma once

#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/sources/open_source.hpp>

namespace CLI {
class App;
}

namespace tilth::app {

/// --topic, --frame, --rate, and a flag for each option of packets and of point clouds. `source` outlives the parsing.
void add_source_flags(CLI::App& command, SourceOptions& source);

/// What those flags say, each as source.KEY; with SourceOptions{} what they say where none is given.
std::vector<OptionInfo> describe_source(const SourceOptions& source);

}  // namespace tilth::app

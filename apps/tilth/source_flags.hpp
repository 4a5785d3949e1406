// What the command line says of SOURCE: the flags of `tilth run`, `info` and `convert`.
#pragma once

#include <tilth/sources/open_source.hpp>

namespace CLI {
class App;
}

namespace tilth::app {

/// --topic, --frame, --rate, and a flag for each option of packets and of point clouds. `source` outlives the parsing.
void add_source_flags(CLI::App& command, SourceOptions& source);

}  // namespace tilth::app

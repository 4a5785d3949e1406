// The machine that the program runs on, in words.
#pragma once

#include <string>

namespace tilth::app {

/// Processor, number of processors, memory and system: "Intel(R) Xeon(R) ..., 2 processors, 24 GB, Linux 6.1 (x86_64)".
/// What the system does not tell is left out.
std::string machine_name();

}  // namespace tilth::app

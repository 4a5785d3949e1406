// The machine that a program runs on, and what the program takes of it.
#pragma once

#include <string>

namespace tilth {

/// Processor, number of processors, memory and system: "Intel(R) Xeon(R) ..., 2 processors, 24 GB, Linux 6.1 (x86_64)".
/// What the system does not tell is left out.
std::string machine_name();

double peak_megabytes();  ///< [MB] resident, of this process

}  // namespace tilth

#include "process.hpp"

#include <sys/resource.h>

namespace tilth::app {

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024e-6;
}

}  // namespace tilth::app

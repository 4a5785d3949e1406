#include <cmath>
#include <fstream>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

#include <tilth/run/machine.hpp>

namespace tilth {
namespace {

/// The processor's own name, empty where the system does not tell it.
std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return {};
}

double memory_gigabytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? 1e-9 * double(pages) * double(page) : 0.0;
}

}  // namespace

std::string machine_name() {
  std::string name = processor_name();
  if (!name.empty()) name += ", ";
  const unsigned processors = std::thread::hardware_concurrency();
  name += std::to_string(processors) + (processors == 1 ? " processor" : " processors");
  if (memory_gigabytes() > 0) name += ", " + std::to_string(std::lround(memory_gigabytes())) + " GB";
  utsname system{};
  if (uname(&system) == 0)
    name += std::string(", ") + system.sysname + " " + system.release + " (" + system.machine + ")";
  return name;
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024e-6;
}

}  // namespace tilth

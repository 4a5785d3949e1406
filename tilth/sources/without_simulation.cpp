#include <tilth/core/error.hpp>
#include <tilth/sources/simulated_source.hpp>

namespace tilth {

std::unique_ptr<ScanSource> open_simulation(const std::string& uri) {
  throw Error(uri, "is a simulation, which this build of Tilth has not (TILTH_WITH_SIMULATION is off)");
}

}  // namespace tilth

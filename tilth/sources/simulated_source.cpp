#include <tilth/sources/open_simulator.hpp>
#include <tilth/sources/simulated_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

class SimulatedSource : public ScanSource {
 public:
  SimulatedSource(const std::string& scene, OpenedSimulator opened) : simulator_(std::move(opened.simulator)) {
    const SimulationOptions& options = opened.options;
    for (const std::string& warning : opened.warnings) decisions_.push_back("world file: " + warning);
    decisions_.push_back("scans: simulated, scene " + scene + ", sensor " + options.sensor);
    if (!simulator_->beams().ideal()) decisions_.emplace_back("beams: simulated with constant errors");
    decisions_.emplace_back(options.noise.snapshot ? "times: none, every scan is a snapshot"
                                                   : "times: seconds since the first firing of a scan");
  }

  std::optional<Scan> next() override {
    if (index_ >= simulator_->size()) return std::nullopt;
    return simulator_->scan(index_++).scan;
  }

  std::optional<std::size_t> size() const override { return simulator_->size(); }

 private:
  std::unique_ptr<Simulator> simulator_;
  std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<ScanSource> open_simulation(const std::string& uri) {
  const SourceUri source = parse_source_uri(uri.substr(kSimulatedScheme.size()));
  return std::make_unique<SimulatedSource>(source.what, open_simulator(source.what, source.values));
}

}  // namespace tilth

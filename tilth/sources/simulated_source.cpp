#include <tilth/simulation/simulator.hpp>
#include <tilth/sources/simulated_source.hpp>

namespace tilth {
namespace {

/// The part of `text` before `separator`, which is taken out of it; all of it where there is none.
std::string take_until(std::string& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string taken = text.substr(0, end);
  text.erase(0, end == std::string::npos ? end : end + 1);
  return taken;
}

OptionValues values_of(const std::string& uri, std::string query) {
  OptionValues values;
  while (!query.empty()) {
    std::string setting = take_until(query, '&');
    const std::string key = take_until(setting, '=');
    if (key.empty() || setting.empty()) throw Error(uri, "has a part after the question mark that is no key=value");
    values[key] = setting;
  }
  return values;
}

class SimulatedSource : public ScanSource {
 public:
  SimulatedSource(const std::string& scene, const SimulationOptions& options) : simulator_(scene, options) {
    decisions_.push_back("scans: simulated, scene " + scene + ", sensor " + options.sensor);
    decisions_.push_back(options.noise.snapshot ? "times: none, every scan is a snapshot"
                                                : "times: seconds since the first firing of a scan");
  }

  std::optional<Scan> next() override {
    if (index_ >= simulator_.size()) return std::nullopt;
    return simulator_.scan(index_++).scan;
  }

  std::optional<std::size_t> size() const override { return simulator_.size(); }

 private:
  Simulator simulator_;
  std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<ScanSource> open_simulation(const std::string& uri) {
  std::string query = uri.substr(kSimulatedScheme.size());
  const std::string scene = take_until(query, '?');
  return std::make_unique<SimulatedSource>(scene, simulation_options(scene, values_of(uri, query)));
}

}  // namespace tilth

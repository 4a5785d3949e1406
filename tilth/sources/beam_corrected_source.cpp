#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sources/beam_corrected_source.hpp>

namespace tilth {
namespace {

std::string has_errors_of(std::size_t beams) {
  return "has the errors of " + std::to_string(beams) + " beams";
}

class BeamCorrectedSource : public ScanSource {
 public:
  BeamCorrectedSource(std::unique_ptr<ScanSource> source, BeamModel beams, std::string file)
      : source_(std::move(source)), beams_(std::move(beams)), file_(std::move(file)) {
    contents_ = source_->contents();
  }

  std::optional<Scan> next() override {
    std::optional<Scan> scan;
    try {
      scan = source_->next();
    } catch (...) {
      take_over();
      throw;
    }
    take_over();
    if (!scan || scan->cloud.empty()) return scan;
    check(scan->cloud);
    return corrected(*scan, beams_);
  }

  std::optional<std::size_t> size() const override { return source_->size(); }
  std::vector<std::string> notices() const override { return source_->notices(); }

 private:
  /// What the source has decided, with our own sentence at its end, and what it has passed over.
  void take_over() {
    const std::vector<std::string>& decided = source_->decisions();
    if (decisions_.size() != decided.size() + 1) {
      decisions_ = decided;
      decisions_.push_back("beams: " + (beams_.ideal()
                                            ? file_ + " has nothing to correct"
                                            : "corrected by " + file_ + " (" + largest_errors(beams_) + ")"));
    }
    for (std::size_t i = skipped_.size(); i < source_->skipped().size(); ++i) skipped_.push_back(source_->skipped()[i]);
  }

  void check(const PointCloud& cloud) const {
    if (!cloud.has_rings()) {
      throw Error(file_, has_errors_of(beams_.beams()) + ", but the scans have no rings that tell their beams apart");
    }
    require_beams(beams_, std::size_t{1} + *std::max_element(cloud.rings.begin(), cloud.rings.end()), file_);
  }

  std::unique_ptr<ScanSource> source_;
  BeamModel beams_;
  std::string file_;
};

double largest(const std::vector<double>& errors) {
  double most = 0;
  for (const double error : errors) most = std::max(most, std::abs(error));
  return most;
}

}  // namespace

void require_beams(const BeamModel& beams, std::size_t rings, const std::string& file) {
  if (beams.beams() == 0 || rings <= beams.beams()) return;
  throw Error(file, has_errors_of(beams.beams()) + ", but the scans are of " + std::to_string(rings) +
                        ": it is of another sensor");
}

std::unique_ptr<ScanSource> beam_corrected_source(std::unique_ptr<ScanSource> source, BeamModel beams,
                                                  std::string file) {
  return std::make_unique<BeamCorrectedSource>(std::move(source), std::move(beams), std::move(file));
}

std::string largest_errors(const BeamModel& beams) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::string text;
  const auto add = [&](const char* what, double value, const char* format) {
    if (value == 0) return;
    char number[32];
    std::snprintf(number, sizeof number, format, value);
    text += (text.empty() ? "" : ", ") + std::string(what) + " up to " + number;
  };
  add("ranges", 1e3 * largest(beams.range), "%.0f mm");
  add("elevations", largest(beams.elevation) / kDegree, "%.2f deg");
  add("azimuths", largest(beams.azimuth) / kDegree, "%.2f deg");
  add("encoder", (beams.encoder.head<2>().norm() + beams.encoder.tail<2>().norm()) / kDegree, "%.3f deg");
  add("dim returns", 1e3 * std::abs(beams.walk), "%.0f mm");
  add("scale", 1e2 * std::abs(beams.range_scale), "%.2f %%");
  return text;
}

}  // namespace tilth

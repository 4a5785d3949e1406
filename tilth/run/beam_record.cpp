#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <tilth/run/beam_record.hpp>
#include <tilth/sources/beam_corrected_source.hpp>

namespace tilth {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kWorthATelling = 2e-3;  // [m] of a beam's residual
constexpr double kWorthAPass = 3e-3;     // [m] that returns are moved by, at
constexpr double kUsualRange = 10;       // [m]

template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// ", beam 5 reads 17.2 mm short" of the one that is farthest off; nothing where none is.
std::string worst_beam(const std::vector<double>& residual) {
  std::size_t worst = 0;
  for (std::size_t k = 1; k < residual.size(); ++k) {
    if (!(std::abs(residual[k]) <= std::abs(residual[worst])) && !std::isnan(residual[k])) worst = k;
  }
  if (residual.empty() || !(std::abs(residual[worst]) > kWorthATelling)) return {};
  return line(", beam %zu reads %.1f mm %s", worst, std::abs(residual[worst]) / kMillimetre,
              residual[worst] > 0 ? "long" : "short");
}

/// [m] by which errors theta of n beams move a return at that range, root mean square.
double displacement(const Eigen::VectorXd& theta, std::size_t n, double range) {
  const Eigen::Index beams = Eigen::Index(n);
  const double ranges = theta.head(beams).squaredNorm(), elevations = theta.segment(beams, beams).squaredNorm();
  const double walk = theta[2 * beams], encoder = theta.tail<4>().squaredNorm() / 2;
  return std::sqrt(ranges / double(n) + walk * walk + range * range * (elevations / double(n) + encoder));
}

nlohmann::ordered_json fit_json(const BeamFit& fit) {
  return {{"thickness_m", fit.thickness}, {"residual_m", fit.residual}};
}

}  // namespace

std::string beams_sentence(const BeamCalibration& found) {
  std::string text = line("surfaces are %.1f mm thick", found.before.thickness / kMillimetre);
  text += worst_beam(found.before.residual);
  if (found.believed == 0) return text + "; no errors found that windows agree on";
  return text + line("; errors found in %zu of %zu directions (", found.believed, found.directions) +
         largest_errors(found.beams.model) + ")";
}

std::string beams_json(const BeamCalibration& found) {
  return nlohmann::ordered_json{{"windows", found.windows},         {"keyframes", found.keyframes},
                                {"directions", found.directions},   {"believed", found.believed},
                                {"before", fit_json(found.before)}, {"after", fit_json(found.after)}}
      .dump();
}

bool worth_a_second_pass(const BeamCalibration& found, const BeamModel& known) {
  const std::size_t n = found.beams.model.beams();
  if (found.believed == 0 || n == 0) return false;
  return displacement(parameters_of(found.beams.model, n) - parameters_of(known, n), n, kUsualRange) > kWorthAPass;
}

}  // namespace tilth

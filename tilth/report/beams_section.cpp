#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <tilth/report/run_sections.hpp>
#include <tilth/run/beam_record.hpp>

namespace tilth {
namespace {

constexpr double kMillimetre = 1e-3, kDegree = std::numbers::pi / 180;

std::string number(double value, double unit, const char* format) {
  if (std::isnan(value)) return "saw no surface";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value / unit);
  return text.data();
}

Table beams_table(const BeamCalibration& found) {
  Table table{"Beams, the lowest first",
              {"beam", "range error [mm]", "±", "elevation error [deg]", "±", "residual before [mm]", "after [mm]"},
              {},
              true};
  const auto n = Eigen::Index(found.beams.model.beams());
  const Eigen::VectorXd error = parameters_of(found.beams.model, std::size_t(n));
  const Eigen::VectorXd deviation = found.beams.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  for (Eigen::Index k = 0; k < n; ++k) {
    table.rows.push_back({std::to_string(k), number(error[k], kMillimetre, "%.1f"),
                          number(deviation[k], kMillimetre, "%.1f"), number(error[n + k], kDegree, "%.3f"),
                          number(deviation[n + k], kDegree, "%.3f"),
                          number(found.before.residual[std::size_t(k)], kMillimetre, "%.2f"),
                          number(found.after.residual[std::size_t(k)], kMillimetre, "%.2f")});
  }
  return table;
}

}  // namespace

Section beams_section(const BeamCalibration& found) {
  return {"beams", "Beams of the sensor", beams_sentence(found) + ".", {beams_table(found)}, {}};
}

}  // namespace tilth

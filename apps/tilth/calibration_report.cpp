#include "calibration_report.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace tilth::app {
namespace {

constexpr double kMillimetre = 1e-3, kDegree = std::numbers::pi / 180;
constexpr double kShown = 0.7;  // of the prior's deviation that is left, at most

template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// In words of `unit`, with so many digits behind the point; no "-0.0".
std::string number(double value, double unit, int digits) {
  const double step = std::pow(10.0, -digits);
  return std::isnan(value) ? "none" : line("%.*f", digits, std::round(value / unit / step) * step + 0.0);
}

std::string with_deviation(double error, double deviation, double unit, int digits) {
  return number(error, unit, digits) + " +- " + number(deviation, unit, digits);
}

/// The same in columns.
std::string aligned(double error, double deviation, double unit, int digits) {
  return line("%8s +- %5s", number(error, unit, digits).c_str(), number(deviation, unit, digits).c_str());
}

std::string harmonic_line(const char* name, const Eigen::Vector2d& error, const Eigen::Vector2d& deviation) {
  return line("encoder, %s harmonic: cos %s, sin %s deg\n", name,
              with_deviation(error[0], deviation[0], kDegree, 3).c_str(),
              with_deviation(error[1], deviation[1], kDegree, 3).c_str());
}

/// Of consecutive numbers first and last: "6 to 9, 12".
std::string ranges_of(const std::vector<Eigen::Index>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
    if (end - i > 1) text += " to " + std::to_string(numbers[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace

std::string calibration_table(const BeamCalibration& found, double metres) {
  const auto n = Eigen::Index(found.beams.model.beams());
  const Eigen::VectorXd error = parameters_of(found.beams.model, std::size_t(n));
  const Eigen::VectorXd deviation = found.beams.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  std::string text = line("%zu windows, %zu keyframes, %.1f m driven\n", found.windows, found.keyframes, metres);
  text += "beam  range error [mm]  elevation error [deg]  residual [mm]\n";
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::string before = number(found.before.residual[std::size_t(k)], kMillimetre, 2);
    const std::string after = number(found.after.residual[std::size_t(k)], kMillimetre, 2);
    text += line("%4d  %s  %s        %6s -> %5s\n", int(k), aligned(error[k], deviation[k], kMillimetre, 1).c_str(),
                 aligned(error[n + k], deviation[n + k], kDegree, 3).c_str(), before.c_str(), after.c_str());
  }
  text +=
      "the darkest returns read long by " + with_deviation(error[2 * n], deviation[2 * n], kMillimetre, 1) + " mm\n";
  text += harmonic_line("first", error.segment<2>(2 * n + 1), deviation.segment<2>(2 * n + 1));
  text += harmonic_line("second", error.segment<2>(2 * n + 3), deviation.segment<2>(2 * n + 3));
  text += line("thickness of surfaces: %.1f -> %.1f mm\n", found.before.thickness / kMillimetre,
               found.after.thickness / kMillimetre);
  return text + line("errors found in %zu of %zu directions", found.believed, found.directions);
}

std::vector<std::string> not_shown(const BeamEstimate& prior, const BeamEstimate& posterior) {
  const Eigen::Index n = (posterior.covariance.rows() - 5) / 2;
  const auto hidden = [&](Eigen::Index first, Eigen::Index count) {
    std::vector<Eigen::Index> numbers;
    for (Eigen::Index i = first; i < first + count; ++i) {
      if (posterior.covariance(i, i) > kShown * kShown * prior.covariance(i, i)) numbers.push_back(i - first);
    }
    return numbers;
  };
  std::vector<std::string> sentences;
  const auto add_beams = [&](const std::string& what, const std::vector<Eigen::Index>& beams) {
    if (beams.empty()) return;
    sentences.push_back(what + (beams.size() > 1 ? " of beams " : " of beam ") + ranges_of(beams));
  };
  add_beams("range", hidden(0, n));
  add_beams("elevation", hidden(n, n));
  if (!hidden(2 * n, 1).empty()) sentences.emplace_back("what dim returns read long");
  if (!hidden(2 * n + 1, 2).empty()) sentences.emplace_back("first harmonic of the encoder");
  if (!hidden(2 * n + 3, 2).empty()) sentences.emplace_back("second harmonic of the encoder");
  return sentences;
}

}  // namespace tilth::app

#include <cstdio>
#include <limits>
#include <map>
#include <numbers>

#include <yaml-cpp/yaml.h>

#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/unit_number.hpp>

namespace tilth {
namespace {

constexpr FileUnit kMetre{1, 1.0, " m"}, kDegree{std::numbers::pi_v<long double> / 180, 5.0, " deg"};
constexpr FileUnit kScale{1, 0.1, ""}, kIntensity{1, 65535.0, ""}, kAny{1, std::numeric_limits<double>::max(), ""};
constexpr std::size_t kMostBytes = 1 << 22, kMostBeams = 256;

template <class Values>
std::string list_of(const Values& values, const FileUnit& unit) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + text_of(value, unit);
  return "[" + list + "]";
}

/// Three digits of each.
std::string deviations_of(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd all = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::Index n = (all.size() - 5) / 2;
  const auto some = [&](Eigen::Index first, Eigen::Index count, const FileUnit& unit) {
    std::string list;
    for (const double deviation : all.segment(first, count)) {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.3g", double(deviation / unit.size));
      list += (list.empty() ? "" : ", ") + std::string(text.data());
    }
    return list;
  };
  return "deviations:  # standard, of the covariance; for people, not read\n  range: [" + some(0, n, kMetre) +
         "]  # [m]\n  elevation: [" + some(n, n, kDegree) + "]  # [deg]\n  walk: " + some(2 * n, 1, kMetre) +
         "  # [m]\n  encoder: [" + some(2 * n + 1, 4, kDegree) + "]  # [deg]\n";
}

std::string triangle_of(const Eigen::MatrixXd& covariance) {
  std::string text = "covariance:  # lower triangle, of range [m], elevation [rad], walk [m], encoder [rad]\n";
  for (Eigen::Index i = 0; i < covariance.rows(); ++i)
    text += "  - " + list_of(covariance.row(i).head(i + 1), kAny) + "\n";
  return text;
}

std::string text_of(const BeamEstimate& estimate) {
  const BeamModel& m = estimate.model;
  std::string text = "# Constant errors of a sensor's beams: what is measured minus what is true.\nversion: 1\n";
  text += "range: " + list_of(m.range, kMetre) + "  # [m] of each ring, the lowest first; []: none\n";
  text += "elevation: " + list_of(m.elevation, kDegree) + "  # [deg] of each ring\n";
  text += "azimuth: " + list_of(m.azimuth, kDegree) + "  # [deg] of each ring\n";
  text += "encoder: " + list_of(m.encoder, kDegree) + "  # [deg] of cos a, sin a, cos 2a, sin 2a of the azimuth a\n";
  text += "range_scale: " + text_of(m.range_scale, kScale) + "  # [-] by which ranges read long, as a share of them\n";
  text += "walk: " + text_of(m.walk, kMetre) + "  # [m] by which the darkest returns read long\n";
  text += "bright: " + text_of(m.bright, kIntensity) + "  # intensity from which on a return does not walk\n";
  if (estimate.covariance.size() > 0) text += deviations_of(estimate.covariance) + triangle_of(estimate.covariance);
  return text;
}

/// What stands under one key of the file.
struct Entry {
  std::string file, key;
  YAML::Node node;

  std::string where(const YAML::Node& at) const {
    const YAML::Mark mark = at.Mark();
    return file + (mark.is_null() ? "" : ", line " + std::to_string(mark.line + 1)) + ", key " + key;
  }
  [[noreturn]] void refuse(const std::string& what) const { throw Error(where(node), what); }

  double number(const YAML::Node& at, const FileUnit& unit) const {
    return number_of(at.IsScalar() ? at.Scalar() : "", unit, where(at));
  }
  double number(const FileUnit& unit) const { return number(node, unit); }

  std::vector<double> list(const FileUnit& unit) const {
    if (!node.IsSequence()) refuse("is no list of numbers");
    if (node.size() > kMostBeams) refuse("has more than " + std::to_string(kMostBeams) + " beams");
    std::vector<double> values;
    for (const YAML::Node& each : node) values.push_back(number(each, unit));
    return values;
  }
};

using Entries = std::map<std::string, Entry>;

Entries entries_of(const YAML::Node& root, const std::string& name) {
  if (!root.IsMap()) throw Error(name, "is no map of the errors of beams (range: [...])");
  Entries entries;
  for (const auto& each : root) {
    Entry entry{name, each.first.IsScalar() ? each.first.Scalar() : "", each.second};
    if (!entries.emplace(entry.key, entry).second) entry.refuse("is given twice");
  }
  return entries;
}

Eigen::MatrixXd covariance_of(const Entry& entry, std::size_t beams) {
  const std::size_t size = parameter_count(beams);
  const std::string expected =
      ", expected the lower triangle of " + std::to_string(size) + " rows (" + std::to_string(beams) + " beams)";
  if (!entry.node.IsSequence() || entry.node.size() != size)
    entry.refuse("has " + std::to_string(entry.node.size()) + " rows" + expected);
  Eigen::MatrixXd covariance(size, size);
  Eigen::Index i = 0;
  for (const YAML::Node& row : entry.node) {
    if (!row.IsSequence() || row.size() != std::size_t(i) + 1)
      throw Error(entry.where(row), "has " + std::to_string(row.size()) + " values in a row" + expected);
    Eigen::Index j = 0;
    for (const YAML::Node& each : row) covariance(i, j) = covariance(j, i) = entry.number(each, kAny), ++j;
    ++i;
  }
  if (!positive_semidefinite(covariance)) entry.refuse("is not positive semidefinite");
  return covariance;
}

/// Takes over all but the covariance, and says whether the key is one.
bool take(const Entry& entry, BeamModel& model) {
  if (entry.key == "range") return model.range = entry.list(kMetre), true;
  if (entry.key == "elevation") return model.elevation = entry.list(kDegree), true;
  if (entry.key == "azimuth") return model.azimuth = entry.list(kDegree), true;
  if (entry.key == "range_scale") return model.range_scale = entry.number(kScale), true;
  if (entry.key == "walk") return model.walk = entry.number(kMetre), true;
  if (entry.key == "bright") {
    model.bright = entry.number(kIntensity);
    if (!(model.bright > 0)) entry.refuse("is " + entry.node.Scalar() + ", expected more than 0");
    return true;
  }
  if (entry.key != "encoder") return entry.key == "version" || entry.key == "deviations" || entry.key == "covariance";
  const std::vector<double> list = entry.list(kDegree);
  if (list.size() != 4) entry.refuse("has " + std::to_string(list.size()) + " values, expected 4");
  return model.encoder = Eigen::Vector4d::Map(list.data()), true;
}

BeamEstimate estimate_of(const Entries& entries, const std::string& name) {
  const auto version = entries.find("version");
  if (version == entries.end()) throw Error(name, "has no key version");
  if (!version->second.node.IsScalar() || version->second.node.Scalar() != "1")
    version->second.refuse("is not 1, the only one that is known");
  BeamEstimate estimate;
  for (const auto& [key, entry] : entries) {
    if (!take(entry, estimate.model)) {
      entry.refuse(
          "is not known; there are version, range, elevation, azimuth, encoder, range_scale, walk, bright, "
          "deviations and covariance");
    }
  }
  const std::size_t beams = estimate.model.beams();
  for (const char* key : {"range", "elevation", "azimuth"}) {
    const auto list = entries.find(key);
    if (list == entries.end() || list->second.node.size() == 0 || list->second.node.size() == beams) continue;
    list->second.refuse("has " + std::to_string(list->second.node.size()) + " beams, another list " +
                        std::to_string(beams));
  }
  const auto covariance = entries.find("covariance");
  if (covariance != entries.end()) estimate.covariance = covariance_of(covariance->second, beams);
  return estimate;
}

}  // namespace

void write_beams(const std::filesystem::path& path, const BeamEstimate& estimate) {
  write_text(path, text_of(estimate));
}

BeamEstimate parse_beams(const std::string& text, const std::string& name) {
  if (text.size() > kMostBytes) throw Error(name, "has more than " + std::to_string(kMostBytes) + " bytes");
  try {
    return estimate_of(entries_of(YAML::Load(text), name), name);
  } catch (const YAML::Exception& error) {
    throw Error(name + (error.mark.is_null() ? "" : ", line " + std::to_string(error.mark.line + 1)),
                "is no YAML: " + error.msg);
  }
}

BeamEstimate read_beams(const std::filesystem::path& path) {
  return parse_beams(std::string(as_text(read_file(path))), path.string());
}

}  // namespace tilth

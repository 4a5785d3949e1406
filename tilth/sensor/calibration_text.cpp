// parse_unit_calibration(): what the makers' calibration files say.
#include <charconv>
#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include <yaml-cpp/yaml.h>

#include <tilth/core/error.hpp>
#include <tilth/sensor/unit_calibration.hpp>

namespace tilth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kCentimetre = 0.01;
constexpr std::size_t kMostLasers = 256, kMostBytes = 4 << 20;
constexpr double kLargestOffset = 10.0;  ///< [m]

/// Lasers by their number, from 0 and without a gap.
class LaserList {
 public:
  explicit LaserList(const std::string& name) : name_(name) {}

  void add(std::size_t laser, const LaserCalibration& calibration) {
    if (laser != lasers_.size() || laser >= kMostLasers)
      throw Error(name_,
                  "lists laser " + std::to_string(laser) + " where " + std::to_string(lasers_.size()) + " is expected");
    const LaserOffsets& o = calibration.offsets;
    for (const double angle : {calibration.elevation, o.azimuth}) {
      if (!(std::abs(angle) <= std::numbers::pi)) refuse(laser, "an angle");
    }
    for (const double length : {o.range, o.range_x, o.range_y, o.horizontal, o.vertical}) {
      if (!(std::abs(length) <= kLargestOffset)) refuse(laser, "a length");
    }
    lasers_.push_back(calibration);
  }

  UnitCalibration done() {
    if (lasers_.empty()) throw Error(name_, "tells of no laser; expected db.xml, its YAML, or rows of angles");
    return {name_, std::move(lasers_)};
  }

 private:
  [[noreturn]] void refuse(std::size_t laser, const std::string& what) const {
    throw Error(name_, "has " + what + " of laser " + std::to_string(laser) + " that makes no sense");
  }

  const std::string& name_;
  std::vector<LaserCalibration> lasers_;
};

/// What both of Velodyne's files call by nearly the same names. `value(key)` is 0 where the key is missing.
template <class F>
LaserCalibration velodyne_laser(const F& value, double angle, double length) {
  LaserOffsets offsets;
  offsets.azimuth = -value("rotCorrection") * angle;
  offsets.range = value("distCorrection") * length;
  offsets.range_x = value("distCorrectionX") * length, offsets.range_y = value("distCorrectionY") * length;
  offsets.two_points = offsets.range_x != 0.0 || offsets.range_y != 0.0;
  offsets.vertical = value("vertOffsetCorrection") * length;
  offsets.horizontal = value("horizOffsetCorrection") * length;
  return {value("vertCorrection") * angle, offsets};
}

/// Elements <px> of <points_> with <rotCorrection_> and so on. A file may list more lasers than are enabled.
UnitCalibration parse_xml(std::string_view text, const std::string& name) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) throw Error(name, "is no XML: " + std::string(result.description()));
  LaserList lasers(name);
  const pugi::xpath_node_set enabled = document.select_nodes("//enabled_/item");
  for (const pugi::xpath_node& found : document.select_nodes("//px")) {
    const pugi::xml_node laser = found.node();
    const std::size_t id = laser.child("id_").text().as_uint(unsigned(kMostLasers));
    if (id < enabled.size() && enabled[id].node().text().as_int() == 0) continue;
    const auto number = [&](const std::string& key) { return laser.child((key + "_").c_str()).text().as_double(NAN); };
    const auto value = [&](const char* key) {
      return laser.child((std::string(key) + "_").c_str()) ? number(key) : 0.0;
    };
    lasers.add(id, velodyne_laser(value, kDegree, kCentimetre));
  }
  return lasers.done();
}

/// "distCorrectionX" is dist_correction_x in ROS.
std::string snake_case(std::string_view camel) {
  std::string snake;
  for (const char c : camel) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper) snake += '_';
    snake += upper ? char(c - 'A' + 'a') : c;
  }
  return snake;
}

UnitCalibration parse_yaml(std::string_view text, const std::string& name) {
  try {
    const YAML::Node root = YAML::Load(std::string(text));
    if (!root.IsMap() || !root["lasers"].IsSequence() || root["lasers"].size() > kMostLasers)
      throw Error(name, "has no list of lasers, as the calibration of a Velodyne has");
    LaserList lasers(name);
    for (const YAML::Node& laser : root["lasers"]) {
      const auto value = [&](const char* key) { return laser[snake_case(key)].as<double>(0.0); };
      LaserCalibration calibration = velodyne_laser(value, 1.0, 1.0);
      if (!laser["two_pt_correction_available"].as<bool>(true)) calibration.offsets.two_points = false;
      lasers.add(laser["laser_id"].as<std::size_t>(), calibration);
    }
    return lasers.done();
  } catch (const YAML::Exception& error) {
    throw Error(name, "is no calibration of a Velodyne: " + error.msg);
  }
}

std::vector<double> row_of(std::string line) {
  for (char& c : line) c = c == ',' || c == ';' || c == '\r' ? ' ' : c;
  std::istringstream words(line);
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;) numbers.push_back(number);
  return words.eof() ? numbers : std::vector<double>{};
}

/// Rows with three numbers begin with the laser's; other lines before the first row are headings.
UnitCalibration parse_table(std::string_view text, const std::string& name) {
  std::istringstream lines{std::string(text)};
  LaserList lasers(name);
  std::size_t next = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<double> row = row_of(line);
    if (row.size() != 2 && row.size() != 3) {
      const bool blank = line.find_first_not_of(" \t\r,;") == std::string::npos;
      if (next == 0 || blank || line.starts_with('#')) continue;
      throw Error(name, "has a row that is not elevation and azimuth: " + line.substr(0, 40));
    }
    if (row.size() == 3 && row[0] != double(next + 1))
      throw Error(name,
                  "lists laser " + std::to_string(row[0]) + " where " + std::to_string(next + 1) + " is expected");
    LaserCalibration laser{row[row.size() - 2] * kDegree, {}};
    laser.offsets.azimuth = row.back() * kDegree;
    lasers.add(next++, laser);
  }
  return lasers.done();
}

}  // namespace

UnitCalibration parse_unit_calibration(std::string_view text, const std::string& name) {
  if (text.size() > kMostBytes) throw Error(name, "is too long to be the calibration of a sensor");
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin != std::string_view::npos && text[begin] == '<') return parse_xml(text, name);
  return text.find("lasers:") != std::string_view::npos ? parse_yaml(text, name) : parse_table(text, name);
}

}  // namespace tilth

#include <tilth/sensor/sensor_file.hpp>

namespace tilth {

SensorFile parse_sensor_file(std::string_view text, const std::string& name) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const char first = begin == std::string_view::npos ? '\0' : text[begin];
  if (first == '{') return {name, parse_ouster_metadata(text, name), std::nullopt};
  return {name, std::nullopt, parse_unit_calibration(text, name)};
}

}  // namespace tilth

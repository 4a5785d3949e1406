// tilth sensors: whose packets are understood, one row each.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include <tilth/core/lidar_model.hpp>
#include <tilth/sensor/packet_format.hpp>

namespace tilth::app {
namespace {

using Row = std::vector<std::string>;

template <class... A>
std::string text(const char* format, A... values) {
  char line[96];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// Where the angles of the lasers come from.
std::string angles_of(const PacketFormat& format) {
  switch (format.family) {
    case PacketFamily::velodyne_64: return "its packets, or a file";
    case PacketFamily::leishen_1206: return "table, its device packets";
    case PacketFamily::robosense:
    case PacketFamily::robosense_helios:
      return format.needs_calibration ? "its device packets, or a file" : "table, its device packets";
    default: return format.needs_calibration ? "a file" : "table";
  }
}

bool simulated(const std::string& name) {
  const auto names = lidar_names();
  return std::find(names.begin(), names.end(), name) != names.end() || name == "leishen_c16_v3";
}

Row row_of(const PacketFormat& format) {
  const FactoryPorts ports = factory_ports(format.family);
  const auto [first, last] = std::minmax_element(format.channel_times.begin(), format.channel_times.end());
  return {format.name,
          format.title,
          std::to_string(format.channels()),
          text("%g mm", 1e3 * format.unit),
          text("%.5g us", 1e6 * format.firing_period),
          text("%.5g us", 1e6 * (*last - *first)),
          std::to_string(ports.data) + (ports.device == 0 ? "" : ", " + std::to_string(ports.device)),
          angles_of(format),
          simulated(format.name) ? "yes" : ""};
}

/// Columns as wide as their widest cell.
void print(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] + 2 - row[i].size(), ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    std::printf("%s\n", line.c_str());
  }
}

void list_sensors() {
  std::vector<Row> rows{
      {"name", "sensor", "beams", "range step", "firing", "within it", "ports", "angles from", "simulated"}};
  for (const PacketFormat& format : packet_formats()) rows.push_back(row_of(format));
  rows.push_back({"ouster", "Ouster OS0, OS1, OS2", "16 to 128", "1 mm, 8 mm", "a column", "at once", "7502",
                  "its metadata (.json)", "os1_64"});
  print(rows);
  std::printf(
      "\nEvery point has the time at which its laser fired, as the maker's firing table tells: to a microsecond, of "
      "an\n"
      "Ouster's column to a nanosecond. Azimuths are told to 0.01 degrees. Ports are those of the factory: points, "
      "device\n"
      "packets. Files are named by --sensor-file.\n");
}

}  // namespace

void add_sensors(CLI::App& app, int&) {
  app.add_subcommand("sensors", "List the sensors whose packets are understood")->callback(list_sensors);
}

}  // namespace tilth::app

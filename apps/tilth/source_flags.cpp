#include "source_flags.hpp"

#include <CLI/CLI.hpp>

#include "option_flags.hpp"
#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sources/packet_source.hpp>

namespace tilth::app {
namespace {

constexpr const char *kTopic = "point cloud topic of a bag with several", *kRate = "of scans without recorded times",
                     *kFrame = "frame_id of the sensor to read, where a topic has clouds of several";

std::vector<OptionInfo> value_options() {
  std::vector<OptionInfo> all = describe(PacketSourceOptions{});
  const std::vector<OptionInfo> clouds = describe(CloudOptions{});
  all.insert(all.end(), clouds.begin(), clouds.end());
  return all;
}

}  // namespace

void add_source_flags(CLI::App& command, SourceOptions& source) {
  command.add_option("--topic", source.topic, kTopic);
  command.add_option("--frame", source.frame, kFrame);
  command.add_option("--rate", source.rate, std::string("[Hz] ") + kRate)->check(CLI::PositiveNumber);
  add_option_flags(command, value_options(), source.values);
}

std::vector<OptionInfo> describe_source(const SourceOptions& source) {
  const std::string rate = source.rate > 0.0 ? options_detail::number_text(source.rate) : "";
  std::vector<OptionInfo> rows{{"topic", source.topic, "-", kTopic, "text"},
                               {"frame", source.frame, "-", kFrame, "text"},
                               {"rate", rate, "Hz", kRate, "> 0"}};
  for (OptionInfo& option : value_options()) {
    const auto given = source.values.find(option.key);
    if (given != source.values.end()) option.value = given->second;
    rows.push_back(std::move(option));
  }
  for (OptionInfo& row : rows) row.key = "source." + row.key;
  return rows;
}

}  // namespace tilth::app

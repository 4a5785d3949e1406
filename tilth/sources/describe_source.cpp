#include <utility>

#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sources/describe_source.hpp>
#include <tilth/sources/packet_source.hpp>

namespace tilth {

std::vector<OptionInfo> source_value_options() {
  std::vector<OptionInfo> all = describe(PacketSourceOptions{});
  const std::vector<OptionInfo> clouds = describe(CloudOptions{});
  all.insert(all.end(), clouds.begin(), clouds.end());
  return all;
}

std::vector<OptionInfo> describe_source(const SourceOptions& source) {
  const std::string rate = source.rate > 0.0 ? options_detail::number_text(source.rate) : "";
  const SourceMeanings meanings;
  std::vector<OptionInfo> rows{{"topic", source.topic, "-", meanings.topic, "text"},
                               {"frame", source.frame, "-", meanings.frame, "text"},
                               {"rate", rate, "Hz", meanings.rate, "> 0"}};
  for (OptionInfo& option : source_value_options()) {
    const auto given = source.values.find(option.key);
    if (given != source.values.end()) option.value = given->second;
    rows.push_back(std::move(option));
  }
  for (OptionInfo& row : rows) row.key = "source." + row.key;
  return rows;
}

std::vector<OptionInfo> describe_beams(const std::string& file, bool learn, bool keep) {
  return {{"source.beams", file, "-", kBeamsMeaning, "text"},
          {"source.learn_beams", learn ? "true" : "false", "-", kLearnBeamsMeaning, "true | false"},
          {"source.keep_beams", keep ? "true" : "false", "-", kKeepBeamsMeaning, "true | false"}};
}

std::vector<OptionInfo> describe_prior(const std::string& file) {
  return {{"source.prior", file, "-", kPriorMeaning, "text"}};
}

}  // namespace tilth

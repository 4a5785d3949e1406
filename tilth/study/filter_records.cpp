#include <nlohmann/json.hpp>

#include <tilth/study/filter_figures.hpp>
#include <tilth/study/filter_report.hpp>

namespace tilth {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const FilterTrial& trial) {
  Json json{{"recording", trial.recording}, {"options", Json::object()}};
  for (const OptionInfo& option : trial.options) json["options"][option.key] = option.value;
  for (const FilterFigure& figure : figures_of(trial.score)) {
    if (figure.count) {
      json[figure.name] = std::size_t(figure.value);
    } else {
      json[figure.name] = figure.value;
    }
  }
  return json;
}

template <class Cells>
std::string csv_line(const std::string& first, const Cells& cells) {
  std::string line = first;
  for (const std::string& cell : cells) line += "," + cell;
  return line + "\n";
}

std::vector<std::string> names_of(const FilterTrial& trial) {
  std::vector<std::string> names;
  for (const OptionInfo& option : trial.options) names.push_back(option.key);
  for (const FilterFigure& figure : figures_of(trial.score)) names.push_back(figure.name);
  return names;
}

std::vector<std::string> values_of(const FilterTrial& trial) {
  std::vector<std::string> values;
  for (const OptionInfo& option : trial.options) values.push_back(option.value);
  for (const FilterFigure& figure : figures_of(trial.score)) values.push_back(Json(figure.value).dump());
  return values;
}

}  // namespace

std::string filter_csv(std::span<const FilterTrial> trials) {
  std::string text;
  if (!trials.empty()) text = csv_line("recording", names_of(trials[0]));
  for (const FilterTrial& trial : trials) text += csv_line(trial.recording, values_of(trial));
  return text;
}

std::string filter_json(std::span<const FilterTrial> trials) {
  Json json = Json::array();
  for (const FilterTrial& trial : trials) json.push_back(to_json(trial));
  return json.dump(2) + "\n";
}

}  // namespace tilth

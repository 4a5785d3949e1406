#include "option_listing.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

namespace tilth::app {
namespace {

std::vector<std::string> split(const std::string& key) {
  std::vector<std::string> names;
  std::istringstream in(key);
  for (std::string name; std::getline(in, name, '.');) names.push_back(name);
  return names;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::size_t widest(std::span<const OptionInfo> options, std::string OptionInfo::*field) {
  std::size_t width = 0;
  for (const OptionInfo& option : options) width = std::max(width, (option.*field).size());
  return width;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

constexpr std::string_view kAdvancedTitle = "advanced";

struct Parts {
  std::vector<OptionInfo> common, advanced;
};

Parts by_audience(std::span<const OptionInfo> options) {
  Parts parts;
  for (const OptionInfo& option : options) (option.advanced ? parts.advanced : parts.common).push_back(option);
  return parts;
}

std::string markdown_rows(std::span<const OptionInfo> options) {
  std::string text = "| option | default | unit | allowed | meaning |\n|---|---|---|---|---|\n";
  for (const OptionInfo& o : options) {
    text += "| `" + o.key + "` | " + escaped(o.value) + " | " + o.unit + " | " + escaped(o.allowed) + " | " +
            escaped(o.meaning) + " |\n";
  }
  return text;
}

}  // namespace

std::string option_table(const std::string& pipeline, std::span<const OptionInfo> options) {
  const std::size_t keys = widest(options, &OptionInfo::key), values = widest(options, &OptionInfo::value);
  const std::size_t units = widest(options, &OptionInfo::unit) + 2, allowed = widest(options, &OptionInfo::allowed);
  const auto line = [&](const OptionInfo& o) {
    return "  " + padded(o.key, keys) + "  " + padded(o.value, values) + "  " + padded("[" + o.unit + "]", units) +
           "  " + padded(o.allowed, allowed) + "  " + o.meaning + "\n";
  };
  const Parts parts = by_audience(options);
  std::string text = pipeline + "\n";
  for (const OptionInfo& o : parts.common) text += line(o);
  if (!parts.advanced.empty()) text.append(" ").append(kAdvancedTitle).append("\n");
  for (const OptionInfo& o : parts.advanced) text += line(o);
  return text;
}

std::string option_yaml(const std::string& pipeline, std::span<const OptionInfo> options) {
  std::string text = "pipeline: " + pipeline + "\n";
  std::vector<std::string> open;  // the names of the maps that the last line stands in
  for (const OptionInfo& o : options) {
    const std::vector<std::string> names = split(o.key);
    const std::size_t depth = names.size() - 1;
    std::size_t common = 0;
    while (common < depth && common < open.size() && open[common] == names[common]) ++common;
    for (std::size_t i = common; i < depth; ++i) text += std::string(2 * i, ' ') + names[i] + ":\n";
    open.assign(names.begin(), names.end() - 1);
    text += std::string(2 * depth, ' ') + names.back() + ": " + (o.value.empty() ? "\"\"" : o.value) + "  # [" +
            o.unit + "] " + o.meaning + " (" + o.allowed + ")\n";
  }
  return text;
}

std::string option_markdown(const std::string& pipeline, std::span<const OptionInfo> options) {
  const Parts parts = by_audience(options);
  std::string text = "## " + pipeline + "\n\n" + markdown_rows(parts.common);
  if (!parts.advanced.empty())
    text += "\n### " + pipeline + ", " + std::string(kAdvancedTitle) + "\n\n" + markdown_rows(parts.advanced);
  return text;
}

}  // namespace tilth::app

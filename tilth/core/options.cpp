#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tilth/core/options.hpp>

namespace tilth {
namespace options_detail {

std::string number_text(double value) {
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

void refuse(const std::string& key, const std::string& text, const std::string& expected) {
  throw Error("option " + key, "is '" + text + "', expected " + expected);
}

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : " | ") + std::string(name);
  return text;
}

}  // namespace options_detail

namespace {

// Parts of keys as versions up to 0.1 called them, and as they are called now.
constexpr std::pair<std::string_view, std::string_view> kRenamed[] = {{"tremor", "vibration"},
                                                                      {"bend", "motion_model"},
                                                                      {"settle_after", "reanchor_after"},
                                                                      {"min_way", "min_path"},
                                                                      {"way", "path"},
                                                                      {"sweep", "scan_to_scan"},
                                                                      {"jump_share", "jump_ratio"},
                                                                      {"max_gap_share", "max_gap_ratio"},
                                                                      {"spread_share", "spread_ratio"},
                                                                      {"surface_share", "surface_ratio"},
                                                                      {"velocity_share", "velocity_ratio"},
                                                                      {"yaw_share", "yaw_ratio"},
                                                                      {"step_share", "step_ratio"}};

std::string name_today(std::string_view part) {
  for (const auto& [old, today] : kRenamed) {
    if (part == old) return std::string(today);
  }
  return std::string(part);
}

std::string key_today(std::string_view key) {
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return name_today(key);
  return name_today(key.substr(0, dot)) + "." + key_today(key.substr(dot + 1));
}

}  // namespace

void refuse_unknown(const std::string& key, std::span<const OptionInfo> known) {
  const std::string today = key_today(key);
  const bool renamed =
      today != key && std::ranges::any_of(known, [&](const OptionInfo& option) { return option.key == today; });
  throw Error("option " + key, renamed ? "is called " + today + " now" : "is not known (see `tilth config`)");
}

}  // namespace tilth

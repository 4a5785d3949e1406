#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include <tilth/io/column_name.hpp>

namespace tilth {
namespace {

using Words = std::vector<std::string>;

// Compared with lower-case words.
const Words kPositionWords{"t", "p", "pos", "position", "trans", "translation", "location"};
const Words kQuaternionWords{"q", "quat", "quaternion", "ori", "orient", "orientation", "rot", "rotation", "attitude"};
const Words kOtherWords{"v",     "vel", "velocity", "linear",     "angular", "twist",        "a",        "acc",
                        "accel", "b",   "ba",       "bg",         "bias",    "acceleration", "w",        "omega",
                        "gyro",  "cov", "var",      "covariance", "std",     "sigma",        "variance", "error"};
const Words kTimeWords{"t", "time", "times", "utime"};
const Words kSeconds{"s", "sec", "secs", "second", "seconds"};
const Words kNanoseconds{"ns", "nsec", "nsecs", "nanosec", "nanosecs", "nanosecond", "nanoseconds"};
const Words kTimeUnits{"ms", "msec", "us", "usec", "microseconds", "milliseconds"};

bool holds(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A name in lower case: its words, and the unit behind it in brackets.
struct SplitName {
  Words words;
  std::string unit;
};

SplitName split(std::string_view name) {
  SplitName result;
  const std::size_t bracket = std::min(name.find_first_of("[("), name.size());
  for (const char c : name.substr(bracket)) {
    if (std::string_view("[]() ").find(c) == std::string_view::npos) result.unit += char(std::tolower(std::uint8_t(c)));
  }
  std::string word;
  for (const char c : std::string(name.substr(0, bracket)) + " ") {
    if (std::isalnum(std::uint8_t(c))) {
      word += char(std::tolower(std::uint8_t(c)));
    } else if (!word.empty()) {
      result.words.push_back(std::move(word));
      word.clear();
    }
  }
  return result;
}

std::optional<ColumnMeaning> stamp_meaning(const SplitName& name) {
  const std::string& last = name.words.back();
  const auto is_stamp = [](const std::string& word) { return word.ends_with("stamp") || word == "timestamps"; };
  const bool stamp = std::any_of(name.words.begin(), name.words.end(), is_stamp);
  const bool time = holds(kTimeWords, last) || (name.words.size() > 1 && holds(kTimeWords, name.words.front()));
  const bool seconds = holds(kSeconds, last), nanoseconds = holds(kNanoseconds, last);
  if (!stamp && !time && !seconds && !nanoseconds) return std::nullopt;
  ColumnMeaning meaning{nanoseconds ? PoseQuantity::nanoseconds : PoseQuantity::stamp, stamp ? 3 : 2, false, false, {}};
  meaning.unit = name.unit;
  if (meaning.unit.empty() && (seconds || nanoseconds || holds(kTimeUnits, last))) meaning.unit = last;
  if (meaning.unit.empty() && last == "utime") meaning.unit = "us";
  return meaning;
}

/// Of "p_RS_R_x" the nearest word before the letter that says whose coordinate it is; nothing where none does.
std::optional<std::string> owner_of(const Words& words, std::string_view stem) {
  if (!stem.empty()) return std::string(stem);
  for (auto word = words.rbegin() + 1; word != words.rend(); ++word) {
    if (holds(kPositionWords, *word) || holds(kQuaternionWords, *word) || holds(kOtherWords, *word)) return *word;
  }
  return std::nullopt;
}

PoseQuantity coordinate(bool quaternion, char letter) {
  const std::size_t axis = letter == 'w' ? 3 : std::size_t(letter - 'x');
  return PoseQuantity(std::size_t(quaternion ? PoseQuantity::qx : PoseQuantity::x) + axis);
}

std::optional<ColumnMeaning> coordinate_meaning(const SplitName& name) {
  const std::string& last = name.words.back();
  const std::string_view stem = std::string_view(last).substr(0, last.size() - 1);
  const char letter = last.back();
  const bool bare = name.words.size() == 1 && stem.empty();
  const std::optional<std::string> owner = owner_of(name.words, stem);
  const bool quaternion = owner && holds(kQuaternionWords, *owner);
  if (quaternion && std::isdigit(std::uint8_t(letter))) return ColumnMeaning{PoseQuantity::qw, 3, false, true, {}};
  if (std::string_view("xyzw").find(letter) == std::string_view::npos) return std::nullopt;
  if (owner && !quaternion && !holds(kPositionWords, *owner)) return std::nullopt;
  if (letter == 'w' && owner && !quaternion) return std::nullopt;
  const int certainty = owner ? 3 : bare ? 2 : 1;
  return ColumnMeaning{coordinate(quaternion || letter == 'w', letter), certainty, bare, false, name.unit};
}

}  // namespace

std::string_view name_of(PoseQuantity quantity) {
  constexpr std::array<std::string_view, kPoseQuantities> kNames{"stamp", "nanoseconds", "tx", "ty", "tz",
                                                                 "qx",    "qy",          "qz", "qw"};
  return kNames[std::size_t(quantity)];
}

std::optional<ColumnMeaning> meaning_of(std::string_view column_name) {
  const SplitName name = split(column_name);
  if (name.words.empty()) return std::nullopt;
  if (const auto coordinate = coordinate_meaning(name)) return coordinate;
  return stamp_meaning(name);
}

}  // namespace tilth

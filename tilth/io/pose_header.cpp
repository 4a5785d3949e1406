#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/pose_header.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

using Meanings = std::vector<std::optional<ColumnMeaning>>;  // one a column
using Units = std::map<std::string, double>;

constexpr auto kPosition = std::size_t(PoseQuantity::x);
constexpr auto kQuaternion = std::size_t(PoseQuantity::qx);

const Units kStampsInSecond{{"", 0},          {"s", 1},          {"sec", 1},
                            {"secs", 1},      {"second", 1},     {"seconds", 1},
                            {"ms", 1e3},      {"msec", 1e3},     {"milliseconds", 1e3},
                            {"us", 1e6},      {"usec", 1e6},     {"microseconds", 1e6},
                            {"ns", 1e9},      {"nsec", 1e9},     {"nsecs", 1e9},
                            {"nanosec", 1e9}, {"nanosecs", 1e9}, {"nanoseconds", 1e9}};
const Units kMetres{{"", 1}, {"m", 1}, {"meters", 1}, {"metres", 1}, {"mm", 1e-3}, {"cm", 1e-2}};

/// The meanings of the names in a line; units that stand alone ("x [m] y [m]") belong to the name before.
Meanings meanings_in(std::string_view line) {
  std::vector<std::string> names;
  for (const std::string_view cell : cells(line)) {
    const bool unit = cell.starts_with('[') || cell.starts_with('(');
    if (unit && !names.empty()) {
      names.back() += cell;
    } else {
      names.emplace_back(cell);
    }
  }
  Meanings meanings;
  for (const std::string& name : names) meanings.push_back(meaning_of(name));
  return meanings;
}

auto is(PoseQuantity quantity) {
  return [quantity](const auto& meaning) { return meaning && !meaning->numbered && meaning->quantity == quantity; };
}

bool names_any(const Meanings& meanings, PoseQuantity quantity) {
  return std::any_of(meanings.begin(), meanings.end(), is(quantity));
}

/// "tx ty tz x y z w", "x y z w x y z": of bare letters that stand twice, the later ones are the quaternion's.
void give_bare_letters(Meanings& meanings) {
  if (!names_any(meanings, PoseQuantity::qw)) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto position = PoseQuantity(kPosition + axis), quaternion = PoseQuantity(kQuaternion + axis);
    if (names_any(meanings, quaternion)) continue;
    if (std::count_if(meanings.begin(), meanings.end(), is(position)) != 2) continue;
    const auto bare = [&](const auto& meaning) { return is(position)(meaning) && meaning->bare; };
    const auto last = std::find_if(meanings.rbegin(), meanings.rend(), bare);
    if (last != meanings.rend()) (*last)->quantity = quaternion;
  }
}

/// The columns that are most certainly `quantity`.
std::vector<std::size_t> columns_called(const Meanings& meanings, PoseQuantity quantity) {
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < meanings.size(); ++i) {
    if (!is(quantity)(meanings[i])) continue;
    if (!best.empty() && meanings[i]->certainty < meanings[best[0]]->certainty) continue;
    if (!best.empty() && meanings[i]->certainty > meanings[best[0]]->certainty) best.clear();
    best.push_back(i);
  }
  return best;
}

/// Of several that may be parts of the stamp the first.
std::optional<std::size_t> column_of(const Meanings& meanings, PoseQuantity quantity, const std::string& where) {
  const std::vector<std::size_t> found = columns_called(meanings, quantity);
  if (found.empty()) return std::nullopt;
  if (found.size() == 1 || std::size_t(quantity) < kPosition) return found[0];
  throw Error(where, "names " + std::string(name_of(quantity)) + " twice, in columns " + std::to_string(found[0] + 1) +
                         " and " + std::to_string(found[1] + 1));
}

double value_of(const Units& known, const std::string& unit, const std::string& where) {
  const auto found = known.find(unit);
  if (found != known.end()) return found->second;
  std::string names;
  for (const auto& [name, value] : known) names.append(names.empty() ? "" : " ").append(name);
  throw Error(where, "has the unit '" + unit + "'; known are " + names);
}

void refuse_missing(const PoseColumns& columns, const Meanings& meanings, const std::string& where) {
  std::string missing;
  for (std::size_t i = kPosition; i < kPoseQuantities; ++i) {
    if (!columns.of[i]) missing.append(" ").append(name_of(PoseQuantity(i)));
  }
  if (missing.empty()) return;
  const bool numbered = std::any_of(meanings.begin(), meanings.end(), [](auto& m) { return m && m->numbered; });
  throw Error(where, "is a header that names no column for" + missing +
                         (numbered ? "; of q0, q1 .. it does not say which is w" : "") +
                         " (read are stamp tx ty tz qx qy qz qw, in any order)");
}

/// A column of nanoseconds alone holds whole stamps.
void set_stamps(PoseColumns& columns, const Meanings& meanings, const std::string& where) {
  auto& stamp = columns.of[std::size_t(PoseQuantity::stamp)];
  auto& part = columns.of[std::size_t(PoseQuantity::nanoseconds)];
  if (!stamp) std::swap(stamp, part);
  if (stamp) columns.stamps_in_second = value_of(kStampsInSecond, meanings[*stamp]->unit, where);
  if (!part) return;
  if (columns.stamps_in_second > 1) part.reset();
  columns.stamps_in_second = std::max(columns.stamps_in_second, 1.0);
}

PoseColumns columns_of(Meanings meanings, const std::string& where) {
  give_bare_letters(meanings);
  PoseColumns columns;
  columns.count = meanings.size();
  for (std::size_t i = 0; i < kPoseQuantities; ++i) columns.of[i] = column_of(meanings, PoseQuantity(i), where);
  refuse_missing(columns, meanings, where);
  set_stamps(columns, meanings, where);
  columns.position_unit = value_of(kMetres, meanings[*columns[PoseQuantity::x]]->unit, where);
  return columns;
}

/// Of a comment of more words than columns those that stand in a row and mean something.
Meanings longest_run(const Meanings& meanings) {
  Meanings longest, run;
  for (const auto& meaning : meanings) {
    if (!meaning) run.clear();
    if (meaning) run.push_back(meaning);
    if (run.size() > longest.size()) longest = run;
  }
  return longest;
}

bool tells_other_order(std::string_view line) {
  std::string letters;
  for (const char c : line) {
    if (std::isalnum(std::uint8_t(c))) letters += char(std::tolower(std::uint8_t(c)));
  }
  constexpr std::array kOrders{"wxyz", "qwqxqyqz", "q0q1q2q3", "q1q2q3q4"};
  return std::any_of(kOrders.begin(), kOrders.end(), [&](auto order) { return letters.find(order) != letters.npos; });
}

}  // namespace

PoseColumns columns_of_header(std::string_view line, const std::string& where) {
  return columns_of(meanings_in(line), where);
}

std::optional<PoseColumns> columns_of_comment(std::string_view line, std::size_t count, const std::string& where) {
  const std::string_view text = line.substr(std::min(line.find_first_not_of(" \t#%/"), line.size()));
  Meanings meanings = meanings_in(text);
  if (meanings.size() != count) meanings = longest_run(meanings);
  const bool quaternion = names_any(meanings, PoseQuantity::qw);
  if (meanings.size() == count && quaternion) return columns_of(meanings, where);
  if (!tells_other_order(text)) return std::nullopt;
  throw Error(where, "tells an order of the quaternion, but does not name each of the " + std::to_string(count) +
                         " columns; a line such as '# stamp tx ty tz qw qx qy qz' is read");
}

}  // namespace tilth

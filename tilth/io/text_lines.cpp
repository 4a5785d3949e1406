#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include <tilth/core/error.hpp>
#include <tilth/io/text_lines.hpp>

namespace tilth {
namespace {

template <class T>
std::optional<T> parsed(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

template <class T>
bool store(std::string_view word, std::byte* target) {
  std::optional<T> value = parsed<T>(word);
  if constexpr (std::numeric_limits<T>::is_integer) {
    // Some writers put whole numbers down as 3.0 or 1e3.
    if (const std::optional<double> real = value ? std::nullopt : parsed<double>(word)) {
      const bool whole = std::floor(*real) == *real && std::abs(*real) <= 9007199254740992.0;
      if (whole && *real >= double(std::numeric_limits<T>::min()) && *real <= double(std::numeric_limits<T>::max())) {
        value = T(*real);
      }
    }
  } else if (!value) {
    if (const std::optional<double> tiny = parsed<double>(word)) value = T(*tiny);  // beyond float: 0 or infinite
  }
  if (value) std::memcpy(target, &*value, sizeof(T));
  return value.has_value();
}

}  // namespace

std::optional<std::string_view> TextLines::next() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = text_.substr(position_, end - position_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  position_ = std::min(end + 1, text_.size());
  ++number_;
  return line;
}

std::string TextLines::where(const std::string& file) const {
  return file + ", line " + std::to_string(number_);
}

std::vector<std::string_view> words(std::string_view line, std::string_view also) {
  const std::string separators = " \t\r\v\f" + std::string(also);
  std::vector<std::string_view> found;
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    found.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return found;
}

std::vector<std::string_view> cells(std::string_view line) {
  constexpr std::string_view kAround = " \t\r\v\f\"";
  const bool semicolons = line.find(';') != std::string_view::npos;
  if (!semicolons && line.find(',') == std::string_view::npos) return words(line);
  std::vector<std::string_view> found;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(semicolons ? ';' : ',', begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    cell.remove_prefix(std::min(cell.find_first_not_of(kAround), cell.size()));
    cell.remove_suffix(cell.size() - std::min(cell.find_last_not_of(kAround) + 1, cell.size()));
    found.push_back(cell);
    begin = end + 1;
  }
  return found;
}

std::optional<double> to_double(std::string_view word) {
  return parsed<double>(word);
}

std::optional<std::uint64_t> to_count(std::string_view word) {
  return parsed<std::uint64_t>(word);
}

bool store_number(std::string_view word, FieldType type, std::byte* target) {
  switch (type) {
    case FieldType::i8: return store<std::int8_t>(word, target);
    case FieldType::u8: return store<std::uint8_t>(word, target);
    case FieldType::i16: return store<std::int16_t>(word, target);
    case FieldType::u16: return store<std::uint16_t>(word, target);
    case FieldType::i32: return store<std::int32_t>(word, target);
    case FieldType::u32: return store<std::uint32_t>(word, target);
    case FieldType::i64: return store<std::int64_t>(word, target);
    case FieldType::u64: return store<std::uint64_t>(word, target);
    case FieldType::f32: return store<float>(word, target);
    case FieldType::f64: return store<double>(word, target);
  }
  return false;
}

std::optional<std::vector<double>> next_numbers(TextLines& lines, const std::string& file, std::size_t expected) {
  std::vector<std::string_view> found;
  while (found.empty() || found[0][0] == '#') {
    const std::optional<std::string_view> line = lines.next();
    if (!line) return std::nullopt;
    found = words(*line, ",;");
  }
  if (found.size() != expected) {
    throw Error(lines.where(file),
                "has " + std::to_string(found.size()) + " values, expected " + std::to_string(expected));
  }
  std::vector<double> numbers;
  for (const std::string_view word : found) {
    const std::optional<double> number = to_double(word);
    if (!number || !std::isfinite(*number)) {
      throw Error(lines.where(file), "'" + std::string(word.substr(0, 40)) + "' is not a finite number");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::string exact_text(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return {text, end};
}

}  // namespace tilth

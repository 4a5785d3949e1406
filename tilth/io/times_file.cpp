#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/text_lines.hpp>
#include <tilth/io/times_file.hpp>

namespace tilth {

std::vector<double> parse_times(std::string_view text, const std::string& name) {
  std::vector<double> times;
  TextLines lines(text);
  while (const auto numbers = next_numbers(lines, name, 1)) times.push_back(numbers->front());
  if (times.empty()) throw Error(name, "holds no times");
  return times;
}

std::vector<double> read_times(const std::filesystem::path& path) {
  return parse_times(as_text(read_file(path)), path.string());
}

}  // namespace tilth

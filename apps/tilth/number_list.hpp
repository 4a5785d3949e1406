// Lists on the command line: "1-5,8" as numbers, "a,b" as words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilth::app {

/// The numbers of "1-5,8", in their order, each once. Throws Error naming `argument` and the part that is no number or
/// range, falls, or makes more than 10000 numbers of it.
std::vector<std::uint64_t> parse_number_list(const std::string& argument, const std::string& text);

/// The words between commas. Throws Error naming `argument` where one is empty.
std::vector<std::string> parse_word_list(const std::string& argument, const std::string& text);

}  // namespace tilth::app

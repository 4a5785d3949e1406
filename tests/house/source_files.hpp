// The project's own C++ files as text, for tests that read the house instead of running it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tilth::house {

struct SourceFile {
  std::string path;  ///< from the root of the project, "tilth/core/se3.hpp"
  std::string text;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Every .hpp and .cpp below `folder` of the project, by path.
inline std::vector<SourceFile> source_files(const std::string& folder) {
  const std::filesystem::path root = TILTH_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".hpp" && extension != ".cpp") continue;
    files.push_back({entry.path().lexically_relative(root).string(), read_text(entry.path())});
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What stands between the brackets or quotes of the file's #include lines.
inline std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> includes;
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with("#include ") && !line.starts_with("#include\t")) continue;
    const std::size_t begin = line.find_first_of("<\"") + 1;
    includes.push_back(line.substr(begin, line.find_first_of(">\"", begin) - begin));
  }
  return includes;
}

}  // namespace tilth::house

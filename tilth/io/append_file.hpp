// A text file that grows line by line and is whole at every moment: each line is handed to the system at once, so that
// a program that is killed loses none of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace tilth {

class AppendFile {
 public:
  /// Begins the file anew, or goes on behind its last line. Throws Error with the system's reason.
  AppendFile(const std::filesystem::path& path, bool anew);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void write_line(std::string_view line);  ///< with its end; throws Error (disk full)
  bool empty() const { return empty_; }

 private:
  [[noreturn]] void refuse() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  bool empty_ = true;
};

/// Takes the part behind the last end of line off the file, which a crash of the computer may have left there. Returns
/// the number of lines; 0 where there is no file.
std::size_t keep_whole_lines(const std::filesystem::path& path);

}  // namespace tilth

// The folder of a run: nobody else writes into it meanwhile.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "file_lock.hpp"
#include <tilth/run/output_folder.hpp>

namespace tilth::app {

class LockedFolder {
 public:
  /// As prepare_output_folder(), and locks the folder by its file .lock. Throws Error naming that where another has it.
  LockedFolder(const std::filesystem::path& folder, const std::vector<std::string>& files)
      : folder_(prepared(folder, files)), lock_(folder_ / ".lock", WhenTaken::refuse) {}

  std::filesystem::path operator/(const std::string& file) const { return folder_ / file; }

 private:
  static const std::filesystem::path& prepared(const std::filesystem::path& folder,
                                               const std::vector<std::string>& files) {
    prepare_output_folder(folder, files);
    return folder;
  }

  std::filesystem::path folder_;
  FileLock lock_;
};

}  // namespace tilth::app

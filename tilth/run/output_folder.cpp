#include <system_error>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/run/output_folder.hpp>

namespace tilth {

void prepare_output_folder(const std::filesystem::path& folder, std::span<const std::string> files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder.string(), "cannot be made a folder for output: " + error.message());
  for (const std::string& file : files) OutputFile untouched(folder / file);
}

}  // namespace tilth

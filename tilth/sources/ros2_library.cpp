#include <cstdlib>
#include <dlfcn.h>

#include <tilth/core/error.hpp>
#include <tilth/sources/ros2_library.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "libtilth_ros2.so";

/// Adds the folders that a variable of the environment lists, with `below` behind each.
void add_listed(const char* variable, const fs::path& below, std::vector<fs::path>& folders) {
  const char* value = std::getenv(variable);
  std::string left = value != nullptr ? value : "";
  while (!left.empty()) {
    const std::size_t end = left.find(':');
    if (end != 0) folders.push_back(fs::path(left.substr(0, end)) / below);
    left.erase(0, end == std::string::npos ? end : end + 1);
  }
}

fs::path find_library() {
  std::error_code error;
  for (const fs::path& folder : ros2_library_folders())
    if (fs::exists(folder / kFile, error)) return folder / kFile;
  throw Error(kFile,
              "is not found beside the program, in LD_LIBRARY_PATH or AMENT_PREFIX_PATH: it is built in ros2/ "
              "(docs/ros.md); where it is, the environment of ROS 2 is not set up (source setup.bash), or library=FILE "
              "names it");
}

std::string last_problem() {
  const char* said = dlerror();
  return said != nullptr ? said : "nobody says why";
}

}  // namespace

std::vector<fs::path> ros2_library_folders() {
  std::vector<fs::path> folders;
  std::error_code error;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", error); !error)
    folders = {program.parent_path(), program.parent_path().parent_path() / "lib"};
  add_listed("LD_LIBRARY_PATH", "", folders);
  add_listed("AMENT_PREFIX_PATH", "lib", folders);
  return folders;
}

const TilthRos2Library& load_ros2_library(const std::string& file) {
  const fs::path path = fs::absolute(file.empty() ? find_library() : fs::path(file));
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    throw Error(path,
                "cannot be loaded (" + last_problem() + "): is the environment of ROS 2 set up (source setup.bash)?");
  void* const entry = dlsym(handle, kRos2Entry);
  if (entry == nullptr)
    throw Error(path, "is not libtilth_ros2 of this version of Tilth (it has no " + std::string(kRos2Entry) + ")");
  return *reinterpret_cast<const TilthRos2Library* (*)()>(entry)();
}

}  // namespace tilth

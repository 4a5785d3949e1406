#include <cstdlib>
#include <sstream>
#include <string_view>

#include <tilth/core/error.hpp>
#include <tilth/gazebo/model_path.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariables[]{"GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "GZ_SIM_RESOURCE_PATH",
                                   "IGN_GAZEBO_RESOURCE_PATH"};

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::vector<std::string> folders_of_environment() {
  std::vector<std::string> folders;
  for (const char* variable : kVariables) {
    const char* value = std::getenv(variable);
    std::istringstream words(value ? value : "");
    for (std::string folder; std::getline(words, folder, ':');) folders.push_back(folder);
  }
  return folders;
}

/// The part of a URI after its scheme, and whether it had one of those that look through the folders.
struct Name {
  fs::path path;
  bool by_folder = false;  // model://, package://: never beside the file
};

/// models/NAME/REST as file:// has it is NAME/REST in a folder of models.
fs::path without_models(const fs::path& path) {
  return path.begin() != path.end() && *path.begin() == "models" ? path.lexically_relative("models") : path;
}

/// `path` in `folder` or in one above it.
std::optional<fs::path> find_above(const fs::path& folder, const fs::path& path) {
  for (fs::path above = fs::absolute(folder).lexically_normal(); above != above.parent_path();
       above = above.parent_path()) {
    if (is_there(above / path)) return above / path;
  }
  return std::nullopt;
}

std::optional<Name> name_of(std::string_view uri) {
  const std::size_t colon = uri.find("://");
  if (colon == std::string_view::npos) return Name{fs::path(uri), false};
  const std::string_view scheme = uri.substr(0, colon), rest = uri.substr(colon + 3);
  if (scheme == "file") return Name{fs::path(rest), false};
  if (scheme == "model" || scheme == "package") return Name{fs::path(rest), true};
  return std::nullopt;
}

}  // namespace

ModelPath::ModelPath(const fs::path& world_file, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (!is_folder(folder)) throw Error("model path " + folder, "is no folder");
    folders_.emplace_back(folder);
  }
  for (const std::string& folder : folders_of_environment()) {
    if (is_folder(folder)) folders_.emplace_back(folder);
  }
  const fs::path own = fs::absolute(world_file).parent_path();
  for (const fs::path& folder : {own, own / "models", own.parent_path() / "models"}) {
    if (is_folder(folder)) folders_.push_back(folder);
  }
}

std::optional<fs::path> ModelPath::find(const std::string& uri, const fs::path& beside) const {
  const std::optional<Name> name = name_of(uri);
  if (!name || name->path.empty()) return std::nullopt;
  if (!name->by_folder) {
    const fs::path near = name->path.is_absolute() ? name->path : beside / name->path;
    if (is_there(near)) return near;
    if (name->path.is_absolute()) return std::nullopt;
  }
  for (const fs::path& folder : folders_) {
    for (const fs::path& path : {name->path, without_models(name->path)}) {
      if (is_there(folder / path)) return folder / path;
    }
  }
  return name->by_folder ? std::nullopt : find_above(beside, name->path);
}

std::string ModelPath::listing() const {
  std::string text;
  for (const fs::path& folder : folders_) {
    if (!text.empty()) text += ':';
    text += folder.string();
  }
  return text;
}

}  // namespace tilth

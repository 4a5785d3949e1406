#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include <tilth/core/error.hpp>
#include <tilth/gazebo/include_finder.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostIncludes = 20'000;

/// The text of a file, or of every SDF file of a model's folder.
std::string text_of(const fs::path& model) {
  std::vector<fs::path> files{model};
  std::error_code error;
  if (fs::is_directory(model, error)) {
    files.clear();
    for (const fs::directory_entry& entry : fs::directory_iterator(model, error)) {
      if (entry.path().extension() == ".sdf") files.push_back(entry.path());
    }
  }
  std::string text;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    text.append(std::istreambuf_iterator<char>(in), {});
  }
  return text;
}

/// What stands in the <uri> of each <include>.
std::vector<std::string> included_uris(const std::string& text) {
  constexpr std::string_view kInclude = "<include", kOpen = "<uri>", kClose = "</uri>", kBlank = " \t\r\n";
  std::vector<std::string> uris;
  for (std::size_t at = text.find(kInclude); at != std::string::npos; at = text.find(kInclude, at + 1)) {
    const std::size_t open = text.find(kOpen, at), close = text.find(kClose, at);
    if (open == std::string::npos || close == std::string::npos || close < open) continue;
    const std::string uri = text.substr(open + kOpen.size(), close - open - kOpen.size());
    const std::size_t first = uri.find_first_not_of(kBlank), last = uri.find_last_not_of(kBlank);
    if (first != std::string::npos) uris.push_back(uri.substr(first, last - first + 1));
  }
  return uris;
}

/// The last part of a URI in small letters, its blanks as underlines: "ground_plane" of the classic and of the later
/// URI.
std::string plain_name(const std::string& uri) {
  std::string name;
  for (std::size_t i = uri.find_last_of('/') + 1; i < uri.size(); ++i) {
    const bool blank = uri[i] == ' ' || uri.compare(i, 3, "%20") == 0;
    if (uri[i] == '%' && blank) i += 2;
    name.push_back(blank ? '_' : char(std::tolower(static_cast<unsigned char>(uri[i]))));
  }
  return name;
}

}  // namespace

std::string IncludeFinder::find(const std::string& uri) {
  if (++includes_ > kMostIncludes) {
    throw Error("include of " + uri, "is one of more than " + std::to_string(kMostIncludes) + " in this world");
  }
  if (const auto path = model_path_.find(uri, folder_)) {
    if (ends(*path)) return path->string();
    warnings_.add("model " + uri + " includes itself; left out");
  } else if (plain_name(uri) == "ground_plane") {
    ground_plane_ = true;
  } else if (plain_name(uri) != "sun") {
    warnings_.add("model " + uri + " is not found in " + model_path_.listing() + "; left out");
  }
  return "";
}

/// Whether no chain of includes leads from the model to one that it has passed already.
bool IncludeFinder::ends(const fs::path& model) {
  if (const auto known = ends_.find(model); known != ends_.end()) return known->second;
  if (!open_.insert(model).second) return false;
  const std::vector<fs::path>& included = included_by(model);
  const bool all = std::all_of(included.begin(), included.end(), [&](const fs::path& m) { return ends(m); });
  open_.erase(model);
  return ends_[model] = all;
}

const std::vector<fs::path>& IncludeFinder::included_by(const fs::path& model) {
  const auto [entry, fresh] = included_.try_emplace(model);
  if (!fresh) return entry->second;
  for (const std::string& uri : included_uris(text_of(model))) {
    if (const auto path = model_path_.find(uri, folder_)) entry->second.push_back(*path);
  }
  return entry->second;
}

}  // namespace tilth

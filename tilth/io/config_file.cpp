#include <yaml-cpp/yaml.h>

#include <tilth/core/error.hpp>
#include <tilth/io/config_file.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20, kMaxKey = 200, kMaxValues = 10000;  // aliases can make a small file endless

std::string where(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ", line " + std::to_string(mark.line + 1);
}

void flatten(const YAML::Node& map, const std::string& prefix, const std::string& file, OptionValues& values) {
  for (const auto& entry : map) {
    const std::string line = where(file, entry.first.Mark());
    if (!entry.first.IsScalar()) throw Error(line, "has a key that is no text");
    const std::string key = prefix + entry.first.Scalar();
    if (key.size() > kMaxKey) throw Error(line, "has a key of more than " + std::to_string(kMaxKey) + " characters");
    if (values.size() > kMaxValues) throw Error(line, "is beyond " + std::to_string(kMaxValues) + " values");
    if (entry.second.IsMap() && entry.second.size() > 0) {
      flatten(entry.second, key + ".", file, values);
      continue;
    }
    if (entry.second.IsSequence()) throw Error(line, "key " + key + " is a list, expected one value");
    if (!entry.second.IsScalar()) throw Error(line, "key " + key + " has no value");
    if (!values.emplace(key, entry.second.Scalar()).second) throw Error(line, "key " + key + " is given twice");
  }
}

}  // namespace

OptionValues parse_config(const std::string& text, const std::string& name) {
  if (text.size() > kMaxBytes) throw Error(name, "has more than " + std::to_string(kMaxBytes) + " bytes");
  OptionValues values;
  try {
    const YAML::Node root = YAML::Load(text);
    if (root.IsNull()) return values;
    if (!root.IsMap()) throw Error(name, "is no map of options (key: value)");
    flatten(root, "", name, values);
  } catch (const YAML::Exception& error) {
    throw Error(where(name, error.mark), "is no YAML: " + error.msg);
  }
  return values;
}

OptionValues read_config(const std::filesystem::path& path) {
  return parse_config(std::string(as_text(read_file(path))), path.string());
}

}  // namespace tilth

#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <mutex>
#include <sstream>

#include <sdf/Console.hh>
#include <sdf/Element.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>

#include <tilth/core/error.hpp>
#include <tilth/gazebo/include_finder.hpp>
#include <tilth/gazebo/sdf_pose.hpp>
#include <tilth/gazebo/world_builder.hpp>

namespace tilth {
namespace {

constexpr std::string_view kWorldHasErrors = "Failed to load a world.";  // said beside the errors themselves

/// "line 12, /sdf/world[...]: what is wrong", as far as the parser tells.
std::string text_of(const sdf::Error& error) {
  std::string text;
  if (error.LineNumber()) text += "line " + std::to_string(*error.LineNumber()) + ", ";
  if (error.XmlPath()) text += *error.XmlPath() + ": ";
  return text + error.Message();
}

/// Its text; what is no SDF is refused before libsdformat takes it for a robot's description.
std::string sdf_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw Error(path.string(), "no such file");
  std::ifstream in(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !in) throw Error(path.string(), "is no file that can be read");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t sdf = text.find("<sdf");
  if (sdf == std::string::npos) throw Error(path.string(), "is no world: it has no element <sdf>");
  const std::string tag = text.substr(sdf, text.find('>', sdf) - sdf);
  if (tag.find("version") == std::string::npos) throw Error(path.string(), "<sdf> has no attribute version");
  return text;
}

/// What libsdformat cannot be kept from saying goes nowhere while this lives: models that it does not find, and its
/// reader of robots' descriptions, write to std::cerr itself.
class NoErrorMessages {
 public:
  NoErrorMessages() : before_(std::cerr.rdbuf(messages_.rdbuf())) {}
  ~NoErrorMessages() { std::cerr.rdbuf(before_); }
  NoErrorMessages(const NoErrorMessages&) = delete;
  NoErrorMessages& operator=(const NoErrorMessages&) = delete;

 private:
  std::ostringstream messages_;
  std::streambuf* before_;
};

/// Worlds of Gazebo classic may have a comment before <?xml ...?>, where XML allows nothing: there it is taken out.
sdf::Errors load(sdf::Root& root, const std::filesystem::path& path, const std::string& text) {
  const std::size_t begin = text.find("<?xml"), end = text.find("?>", std::min(begin, text.size()));
  const NoErrorMessages silence;
  const bool late = begin != std::string::npos && end != std::string::npos && text.find('<') < begin;
  if (!late) return root.Load(std::filesystem::absolute(path).string());
  return root.LoadSdfString(text.substr(0, begin) + text.substr(end + 2));
}

/// libsdformat looks for models within models, and says what is wrong with them, by its global settings alone: they are
/// ours while this lives, of which there is one at a time.
class ParserSettings {
 public:
  explicit ParserSettings(const std::function<std::string(const std::string&)>& find)
      : config_before_(sdf::ParserConfig::GlobalConfig()),
        messages_before_(sdf::Console::Instance()->GetMsgStream().GetStream()) {
    sdf::ParserConfig::GlobalConfig().SetFindCallback(find);
    sdf::Console::Instance()->SetQuiet(true);
    sdf::Console::Instance()->GetMsgStream().SetStream(nullptr);
  }
  ~ParserSettings() {
    sdf::ParserConfig::GlobalConfig() = config_before_;
    sdf::Console::Instance()->SetQuiet(false);
    sdf::Console::Instance()->GetMsgStream().SetStream(messages_before_);
  }
  ParserSettings(const ParserSettings&) = delete;
  ParserSettings& operator=(const ParserSettings&) = delete;

 private:
  static inline std::mutex mutex_;
  std::lock_guard<std::mutex> lock_{mutex_};
  sdf::ParserConfig config_before_;
  std::ostream* messages_before_;
};

}  // namespace

WorldFile read_world_file(const std::filesystem::path& path, const std::vector<std::string>& model_folders) {
  const std::string text = sdf_text(path);
  const ModelPath model_path(path, model_folders);
  Warnings warnings;
  IncludeFinder includes(model_path, std::filesystem::absolute(path).parent_path(), warnings);
  const ParserSettings settings([&](const std::string& uri) { return includes.find(uri); });
  sdf::Root root;
  const sdf::Errors errors = load(root, path, text);
  const sdf::World* world = root.WorldCount() > 0 ? root.WorldByIndex(0) : nullptr;
  if (!world && !root.Model()) {
    if (errors.empty()) throw Error(path.string(), "has neither a <world> nor a <model>");
    const bool torn = errors.front().Code() == sdf::ErrorCode::FILE_READ;  // all that libsdformat says of broken XML
    throw Error(path.string(), torn ? "<sdf> is no well-formed XML" : text_of(errors.front()));
  }
  for (const sdf::Error& error : errors) {
    const bool told = error.Code() == sdf::ErrorCode::URI_LOOKUP || error.Message() == kWorldHasErrors;
    if (!told) warnings.add(text_of(error));
  }
  WorldBuilder builder(model_path, warnings);
  if (includes.ground_plane()) builder.add_ground_plane();
  if (world) builder.add_world(*world, root.Element()->OriginalVersion());
  if (!world) builder.add_model(*root.Model(), root.Model()->Name(), pose_of(root.Model()->RawPose()));
  WorldFile made = builder.take();
  made.warnings = warnings.take();
  if (made.mesh.triangles.empty()) {
    const std::string why = made.warnings.empty() ? "" : ": " + made.warnings.front();
    throw Error(path.string(), "has nothing that a beam could meet" + why);
  }
  return made;
}

}  // namespace tilth

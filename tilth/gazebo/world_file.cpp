#include <fstream>
#include <iterator>

#include <sdf/Console.hh>
#include <sdf/Element.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>

#include <tilth/core/error.hpp>
#include <tilth/gazebo/sdf_pose.hpp>
#include <tilth/gazebo/world_builder.hpp>

namespace tilth {
namespace {

constexpr std::size_t kMostIncludes = 100'000;

/// "line 12, /sdf/world[...]: what is wrong", as far as the parser tells.
std::string text_of(const sdf::Error& error) {
  std::string text;
  if (error.LineNumber()) text += "line " + std::to_string(*error.LineNumber()) + ", ";
  if (error.XmlPath()) text += *error.XmlPath() + ": ";
  return text + error.Message();
}

/// Refuses what is no SDF before libsdformat takes it for a robot's description.
void check_that_it_is_sdf(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw Error(path.string(), "no such file");
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw Error(path.string(), "cannot be read");
  if (text.find("<sdf") == std::string::npos) throw Error(path.string(), "is no world: it has no element <sdf>");
}

/// Finds the models that a world includes. Gazebo's own ground plane and sun need no file.
class IncludeFinder {
 public:
  IncludeFinder(const ModelPath& model_path, const std::filesystem::path& folder, Warnings& warnings)
      : model_path_(model_path), folder_(folder), warnings_(warnings) {}

  std::string find(const std::string& uri) {
    if (++includes_ > kMostIncludes) throw Error("include of " + uri, "is one of more than 100000: models without end");
    if (const auto path = model_path_.find(uri, folder_)) return path->string();
    if (uri == "model://ground_plane") {
      ground_plane_ = true;
    } else if (uri != "model://sun") {
      warnings_.add("model " + uri + " is not found in " + model_path_.listing() + "; left out");
    }
    return "";
  }

  bool ground_plane() const { return ground_plane_; }

 private:
  const ModelPath& model_path_;
  std::filesystem::path folder_;
  Warnings& warnings_;
  std::size_t includes_ = 0;
  bool ground_plane_ = false;
};

}  // namespace

bool is_world_file(const std::string& name) {
  return name.ends_with(".world") || name.ends_with(".sdf");
}

WorldFile read_world_file(const std::filesystem::path& path, const std::vector<std::string>& model_folders) {
  check_that_it_is_sdf(path);
  const ModelPath model_path(path, model_folders);
  Warnings warnings;
  IncludeFinder includes(model_path, std::filesystem::absolute(path).parent_path(), warnings);
  sdf::Console::Instance()->SetQuiet(true);
  sdf::ParserConfig config;
  config.SetFindCallback([&](const std::string& uri) { return includes.find(uri); });
  sdf::Root root;
  const sdf::Errors errors = root.Load(std::filesystem::absolute(path).string(), config);
  const sdf::World* world = root.WorldCount() > 0 ? root.WorldByIndex(0) : nullptr;
  if (!world && !root.Model()) {
    throw Error(path.string(), errors.empty() ? "has neither a world nor a model" : text_of(errors.front()));
  }
  for (const sdf::Error& error : errors) {
    if (error.Code() != sdf::ErrorCode::URI_LOOKUP) warnings.add(text_of(error));
  }
  WorldBuilder builder(model_path, warnings);
  if (includes.ground_plane()) builder.add_ground_plane();
  if (world) builder.add_world(*world, root.Element()->OriginalVersion());
  if (!world) builder.add_model(*root.Model(), root.Model()->Name(), pose_of(root.Model()->RawPose()));
  WorldFile made = builder.take();
  made.warnings = warnings.take();
  if (made.mesh.triangles.empty()) throw Error(path.string(), "has nothing that a beam could meet");
  return made;
}

}  // namespace tilth

#include <functional>

#include <tilth/odometry/floam.hpp>
#include <tilth/odometry/fu2026.hpp>
#include <tilth/odometry/improved_floam.hpp>
#include <tilth/odometry/judged_odometry.hpp>
#include <tilth/odometry/lego_loam.hpp>
#include <tilth/odometry/lio_sam.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/odometry/mounted_odometry.hpp>
#include <tilth/odometry/tilth_odometry.hpp>

namespace tilth {
namespace {

struct PipelineMaker {
  PipelineInfo info;
  std::function<std::unique_ptr<Odometry>(const OptionValues&, const std::shared_ptr<const ExternalMotion>&)> make;
  std::function<std::vector<OptionInfo>(const OptionValues&)> describe;
};

template <class P, class O>
std::unique_ptr<Odometry> made(const std::string& name, const O& options,
                               const std::shared_ptr<const ExternalMotion>& external) {
  if constexpr (std::is_constructible_v<P, O, std::shared_ptr<const ExternalMotion>>) {
    return std::make_unique<P>(options, external);
  } else {
    if (external)
      throw Error("pipeline " + name, "has no use for a prior of the motion; tilth and improved_floam have");
    return std::make_unique<P>(options);
  }
}

template <class P, class O>
PipelineMaker pipeline(const std::string& name, const std::string& summary) {
  return {{name, summary},
          [name](const OptionValues& values, const std::shared_ptr<const ExternalMotion>& external) {
            return made<P>(name, with<O>(values), external);
          },
          [](const OptionValues& values) { return describe(with<O>(values)); }};
}

const std::vector<PipelineMaker>& all() {
  static const std::vector<PipelineMaker> pipelines{
      pipeline<TilthOdometry, TilthOptions>(
          "tilth", "patches of surface, a map by the way they face, pose and velocity estimated together"),
      pipeline<ImprovedFloam, ImprovedFloamOptions>("improved_floam",
                                                    "FLOAM with statistical outlier removal and GICP (Fu et al. 2026)"),
      pipeline<Fu2026, Fu2026Options>("fu2026", "Fu et al. 2026 as printed, to be held against"),
      pipeline<Floam, FloamOptions>("floam", "FLOAM (Wang et al. 2021), as its authors set it for 16 beams"),
      pipeline<LegoLoam, LegoLoamOptions>("lego_loam", "LeGO-LOAM with the LiDAR alone (Shan and Englot 2018)"),
      pipeline<LioSam, LioSamOptions>("lio_sam", "LIO-SAM (Shan et al. 2020) with the LiDAR alone"),
  };
  return pipelines;
}

const PipelineMaker& find(const std::string& name) {
  std::string known;
  for (const PipelineMaker& p : all()) {
    if (p.info.name == name) return p;
    known += (known.empty() ? "" : ", ") + p.info.name;
  }
  throw Error("pipeline " + name, "is not known, expected one of " + known);
}

}  // namespace

std::vector<PipelineInfo> pipelines() {
  std::vector<PipelineInfo> infos;
  for (const PipelineMaker& p : all()) infos.push_back(p.info);
  return infos;
}

std::unique_ptr<Odometry> make_odometry(const std::string& name, const OptionValues& values,
                                        const std::shared_ptr<const ExternalMotion>& external) {
  return std::make_unique<JudgedOdometry>(std::make_unique<MountedOdometry>(find(name).make(values, external)));
}

std::vector<OptionInfo> describe_odometry(const std::string& name, const OptionValues& values) {
  return find(name).describe(values);
}

}  // namespace tilth

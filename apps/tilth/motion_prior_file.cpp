#include "motion_prior_file.hpp"

#include <tilth/core/error.hpp>
#include <tilth/io/pose_file.hpp>

namespace tilth::app {

std::shared_ptr<const ExternalMotion> read_prior(const std::string& file) {
  if (file.empty()) return nullptr;
  const PoseFile poses = read_pose_file(file);
  if (!poses.has_stamps) throw Error(file, "has no stamps, by which a prior is held against the scans");
  return std::make_shared<ExternalMotion>(poses.trajectory);
}

void notice_prior(const ExternalMotion& prior, const std::string& file, RunRecord& record, RunObserver& observer) {
  const Trajectory& way = record.trajectory;
  if (way.size() < 2) return;
  std::size_t told = 0;
  for (std::size_t i = 1; i < way.size(); ++i) told += prior.between(way[i - 1].stamp, way[i].stamp).has_value();
  if (2 * told >= way.size() - 1) return;
  record.notices.push_back(file + " tells of " + std::to_string(told) + " of the " + std::to_string(way.size() - 1) +
                           " motions between scans: are its stamps by the clock of the scans?");
  observer.warn(record.notices.back());
}

}  // namespace tilth::app

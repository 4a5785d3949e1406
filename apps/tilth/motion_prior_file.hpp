// The file of --prior: what another source tells of the motion.
#pragma once

#include <memory>
#include <string>

#include <tilth/odometry/external_motion.hpp>
#include <tilth/run/run_observer.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth::app {

/// None where no file is named. Throws Error where it has no stamps, and as ExternalMotion.
std::shared_ptr<const ExternalMotion> read_prior(const std::string& file);

/// A prior that tells of less than half of the motions of a run is a notice of its record: its clock may be another
/// one.
void notice_prior(const ExternalMotion& prior, const std::string& file, RunRecord& record, RunObserver& observer);

}  // namespace tilth::app

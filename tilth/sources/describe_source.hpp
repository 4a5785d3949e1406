// How a recording is to be read, as rows that documents, the command line and summaries show.
#pragma once

#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {

inline constexpr const char* kBeamsMeaning =
    "file of the errors of the sensor's beams (`tilth calibrate`): every scan is corrected";

inline constexpr const char* kLearnBeamsMeaning =
    "take errors of the beams out of the scans from where the drive has shown them";

inline constexpr const char* kKeepBeamsMeaning =
    "errors of the beams that the drive shows are told only; else the run begins anew without them";

inline constexpr const char* kPriorMeaning =
    "trajectory of the LiDAR by another source (wheels, an IMU, another odometry), by the clock of the scans";

/// The keys of SourceOptions::values: of packets and of point clouds.
std::vector<OptionInfo> source_value_options();

/// Topic, frame and rate, then those keys, each as source.KEY; with SourceOptions{} what they are where none is given.
std::vector<OptionInfo> describe_source(const SourceOptions& source);

/// The file that the scans are corrected by (empty: none), as source.beams, and what becomes of errors that the drive
/// shows, as source.learn_beams and source.keep_beams.
std::vector<OptionInfo> describe_beams(const std::string& file, bool learn, bool keep);

/// The trajectory that is believed beside the scans (empty: none), as source.prior.
std::vector<OptionInfo> describe_prior(const std::string& file);

/// What topic, frame and rate mean.
struct SourceMeanings {
  const char* topic = "point cloud topic of a bag with several";
  const char* frame = "frame_id of the sensor to read, where a topic has clouds of several";
  const char* rate = "of scans without recorded times";
};

}  // namespace tilth

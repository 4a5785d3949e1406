// How a recording is to be read, as rows that documents, the command line and summaries show.
#pragma once

#include <string>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {

inline constexpr const char* kBeamsMeaning =
    "file of the errors of the sensor's beams (`tilth calibrate`): every scan is corrected";

/// The keys of SourceOptions::values: of packets and of point clouds.
std::vector<OptionInfo> source_value_options();

/// Topic, frame and rate, then those keys, each as source.KEY; with SourceOptions{} what they are where none is given.
std::vector<OptionInfo> describe_source(const SourceOptions& source);

/// The file that the scans are corrected by, as source.beams; empty: none.
std::vector<OptionInfo> describe_beams_file(const std::string& file);

/// What topic, frame and rate mean.
struct SourceMeanings {
  const char* topic = "point cloud topic of a bag with several";
  const char* frame = "frame_id of the sensor to read, where a topic has clouds of several";
  const char* rate = "of scans without recorded times";
};

}  // namespace tilth

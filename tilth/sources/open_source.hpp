// Every way a scan can come, by its URI.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <tilth/core/options.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

struct SourceOptions {
  std::string topic = {};              ///< of a bag; empty: the only point cloud topic
  std::string frame = {};              ///< frame_id of the clouds of that topic; empty: the first one's
  double rate = 0.0;                   ///< [Hz] of scans whose times are not recorded; 0: 10 Hz, and said so
  OptionValues values = {};            ///< keys of PacketSourceOptions for packets, of CloudOptions for point clouds
  std::function<bool()> stopped = {};  ///< asked while a live source waits: true ends it; empty: never
};

/// Opens a folder of scans, a KITTI sequence, a bag, packets (a network capture or bare payloads), each as
/// PATH?key=value&... where `values` do not say it all, a sensor (udp://[ADDRESS]:PORT?key=value&...) or a simulation
/// (sim://SCENE?key=value&...). Throws Error naming what is missing, not understood or means nothing for what is there.
std::unique_ptr<ScanSource> open_source(const std::string& uri, const SourceOptions& options = {});

}  // namespace tilth

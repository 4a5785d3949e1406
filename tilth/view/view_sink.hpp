// A run for those who watch it: every scan with its pose, path and map every two seconds, as far as anybody asked for
// them. What it costs does not depend on who watches: about half a millisecond a scan, ten for path and map.
#pragma once

#include <memory>
#include <string>

#include <tilth/run/sink.hpp>
#include <tilth/run/stopwatch.hpp>
#include <tilth/view/view_server.hpp>

namespace tilth {

class ViewSink final : public Sink {
 public:
  explicit ViewSink(std::shared_ptr<ViewServer> server) : server_(std::move(server)) {}

  /// What fails is kept for finish().
  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;

  /// The way and the map as they are in the end.
  void finish(const RunRecord& record) override;

 private:
  void send_scan(const Scan& scan, const OdometryResult& result, const RunRecord& record);
  void send_whole(const RunRecord& record, double stamp);

  std::shared_ptr<ViewServer> server_;
  Stopwatch since_whole_;
  bool sent_whole_ = false;
  std::string problem_;
};

}  // namespace tilth

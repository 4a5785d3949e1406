#include <optional>
#include <utility>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/node/node_sink.hpp>
#include <tilth/node/node_task.hpp>
#include <tilth/node/outlet_observer.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/localization_run.hpp>

namespace tilth {
namespace {

class LocalizingTask final : public NodeTask {
 public:
  LocalizingTask(const NodeSurroundings& around, std::unique_ptr<ScanSource> source, std::unique_ptr<NodeSink> sink,
                 const PlaceMap& map)
      : around_(around),
        map_(map),
        source_(std::move(source)),
        observer_(around.outlet),
        record_(new_record(around.settings)),
        sent_(*sink) {
    search(std::nullopt);
    sinks_.push_back(std::move(sink));
    record_.localization.emplace().map = around.settings.node.map;
    show_map(map, record_);
  }

  void run() override {
    tilth::localize(*source_, *localizer_, {.session = {}, .sinks = sinks_}, observer_, record_);
    for (const std::string& failure : finish_all(sinks_, record_)) around_.outlet.warn(failure);
  }

  std::string save_map() override { throw Error("save_map", "none is made where a saved map is used"); }

  std::string localize(const std::optional<Pose>& T_map_body) override {
    const std::vector<LocalizationRow>& rows = record_.localization->rows;
    const MapState before = rows.empty() ? MapState::searching : rows.back().state;
    search(T_map_body);
    return "the place in " + around_.settings.node.map + " was " + std::string(names_of(before)[std::size_t(before)]) +
           "; it is searched for anew" + (T_map_body ? ", about where it is said to be" : "");
  }

 private:
  /// Forgets where it is; takes the place of a localizer that is at work as well.
  void search(const std::optional<Pose>& T_map_body) {
    std::optional<Pose> T_map_odom;
    if (T_map_body)
      T_map_odom =
          *T_map_body * around_.settings.T_base_lidar.value_or(Pose::Identity()) * sent_.T_odom_lidar().inverse();
    localizer_.emplace(
        map_, [this] { return next_odometry(); }, around_.settings.localization.localize, T_map_odom);
  }

  /// The way in odom has no jump where an odometry takes the place of one that was lost.
  std::unique_ptr<Odometry> next_odometry() const {
    const NodeSettings& settings = around_.settings;
    return std::make_unique<ContinuedOdometry>(make_odometry(settings.node.pipeline, settings.pipeline),
                                               sent_.T_odom_lidar());
  }

  NodeSurroundings around_;
  const PlaceMap& map_;
  std::unique_ptr<ScanSource> source_;
  OutletObserver observer_;
  RunRecord record_;
  std::vector<std::unique_ptr<Sink>> sinks_;  // the one that follows
  const NodeSink& sent_;
  std::optional<Localizer> localizer_;
};

}  // namespace

std::unique_ptr<NodeTask> localizing_task(const NodeSurroundings& around, std::unique_ptr<ScanSource> source,
                                          const std::string& lidar_frame, const PlaceMap& map) {
  return std::make_unique<LocalizingTask>(around, std::move(source),
                                          std::make_unique<NodeSink>(around, nullptr, lidar_frame), map);
}

}  // namespace tilth

#include <system_error>

#include <tilth/atlas/map_writer.hpp>
#include <tilth/atlas/merge_maps.hpp>
#include <tilth/core/error.hpp>
#include <tilth/run/change_record.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/run/track_record.hpp>

namespace tilth {
namespace {

/// A folder that goes when this does.
struct PassingFolder {
  std::filesystem::path path;
  ~PassingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

class SavedMapSink final : public Sink {
 public:
  SavedMapSink(SavedMapPlan plan, const Slam& slam) : plan_(std::move(plan)), slam_(slam) {
    if (plan_.continues.empty()) {
      writer_.emplace(plan_.folder);
      return;
    }
    earlier_.emplace(plan_.continues);
    MapWriter refuses_what_is_no_map(plan_.folder);
  }

  void finish(const RunRecord& record) override {
    require_believed(record);
    if (!earlier_) return write(*writer_, record);
    const PassingFolder own{plan_.folder.string() + ".new"};
    MapWriter writer(own.path);
    write(writer, record);
    const MergedMaps merged = merge_maps(*earlier_, MapFolder(own.path), plan_.localize, plan_.folder);
    if (!plan_.changes.empty()) write_changes(plan_.changes, merged.changes);
  }

 private:
  /// After a loss a map is one again where what was mapped since has been joined to what was mapped before.
  void require_believed(const RunRecord& record) const {
    for (const Keyframe& keyframe : slam_.loops().keyframes()) {
      if (record.scans.rows[keyframe.scan].track.state == TrackState::lost)
        throw Error(plan_.folder.string(), "is not written: " + loss_sentence(record.scans) +
                                               ", and what was mapped since is joined to nothing");
    }
  }

  void write(MapWriter& writer, const RunRecord& record) const {
    const LoopCloser& loops = slam_.loops();
    for (std::size_t i = 0; i < loops.keyframes().size(); ++i) {
      const Keyframe& keyframe = loops.keyframes()[i];
      writer.add({.stamp = keyframe.stamp, .T_map_lidar = loops.poses()[i], .covariance = keyframe.covariance},
                 keyframe.patches);
    }
    std::optional<BeamEstimate> beams;
    if (plan_.beams) beams.emplace().model = *plan_.beams;
    writer.finish({record.version, record.source}, loops.graph(), beams);
  }

  SavedMapPlan plan_;
  const Slam& slam_;
  std::optional<MapWriter> writer_;
  std::optional<MapFolder> earlier_;
};

}  // namespace

std::unique_ptr<Sink> saved_map_sink(SavedMapPlan plan, const Slam& slam) {
  return std::make_unique<SavedMapSink>(std::move(plan), slam);
}

}  // namespace tilth

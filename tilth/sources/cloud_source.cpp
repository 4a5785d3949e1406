#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sources/cloud_source.hpp>
#include <tilth/sources/frame_choice.hpp>

namespace tilth {
namespace {

/// Hands over the messages of one frame one by one, then what is damaged.
class CloudReader {
 public:
  CloudReader(CloudFeed feed, std::shared_ptr<FrameChoice> frames)
      : feed_(std::move(feed)), frames_(std::move(frames)) {}

  std::optional<RecordedScan> operator()() {
    while (!ended_) {
      RecordedScan scan{next_, feed_.name + ", message " + std::to_string(next_), {}, ""};
      ++next_;
      try {
        const std::optional<Message> message = feed_.next();
        if (!message) return end();
        PointCloud2 cloud = parse_point_cloud2(message->bytes, feed_.serialization);
        if (!frames_->takes(cloud.frame_id)) continue;
        scan.records = {{cloud.stamp, 1e-9 * double(message->stamp)}, std::move(cloud.records)};
      } catch (const Error& error) {
        scan.problem = error.what();
      }
      return scan;
    }
    return std::nullopt;
  }

 private:
  std::optional<RecordedScan> end() {
    ended_ = true;
    const std::string problem = feed_.problem ? feed_.problem() : "";
    if (problem.empty()) return std::nullopt;
    return RecordedScan{next_ - 1, feed_.name, {}, "the recording is damaged: " + problem};
  }

  CloudFeed feed_;
  std::shared_ptr<FrameChoice> frames_;
  std::size_t next_ = 0;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<RecordedSource> open_clouds(CloudFeed feed, const std::string& frame, const CloudOptions& options,
                                            std::vector<std::string> decisions) {
  const auto frames = std::make_shared<FrameChoice>(frame);
  const std::string name = feed.name;
  const auto size = feed.size;
  const StampTrust trust = feed.trust;
  decisions.emplace_back("stamps: of the message headers, where they tell scans apart");
  try {
    auto source = std::make_unique<RecordedSource>(CloudReader(std::move(feed), frames),
                                                   RecordingTraits{.times = options.times, .unit = options.unit},
                                                   std::move(decisions), size, trust);
    if (const std::string decision = frames->decision(); !decision.empty()) source->add_decision(decision);
    source->add_notices([frames] { return frames->notices(); });
    return source;
  } catch (const Error&) {
    if (!frames->problem().empty()) throw Error(name, frames->problem());
    throw;
  }
}

}  // namespace tilth

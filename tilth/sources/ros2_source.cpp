#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sources/ros2_source.hpp>

namespace tilth {
namespace {

std::unique_ptr<ScanSource> opened(Ros2Topic& topic) {
  const Ros2Options& options = topic.options();
  CloudFeed feed = feed_of(topic.clouds(), {.name = "topic " + topic.name(),
                                            .frame = std::make_shared<std::string>(options.frame),
                                            .fell_back = [&topic](const std::string& how) { topic.fail(how); }});
  try {
    return open_clouds(std::move(feed), options.frame, options.clouds, {});
  } catch (const Error&) {
    if (const std::string problem = topic.problem(); !problem.empty()) throw Error("topic " + topic.name(), problem);
    if (topic.clouds()->counts().received > 0) throw;
    throw Error("topic " + topic.name(), "no cloud came: " + topic.situation());
  }
}

}  // namespace

Ros2Source::Ros2Source(std::unique_ptr<Ros2Topic> topic) : topic_(std::move(topic)), scans_(opened(*topic_)) {
  contents_ = scans_->contents();
  take_words();
}

Ros2Source::~Ros2Source() {
  topic_->stop();  // whoever reads ahead waits for clouds
}

std::optional<Scan> Ros2Source::next() {
  std::optional<Scan> scan = scans_->next();
  take_words();
  return scan;
}

void Ros2Source::take_words() {
  decisions_ = scans_->decisions();
  const std::vector<SkippedScan>& skipped = scans_->skipped();
  skipped_.insert(skipped_.end(), skipped.begin() + std::ptrdiff_t(skipped_.size()), skipped.end());
}

std::vector<std::string> Ros2Source::notices() const {
  std::vector<std::string> all = scans_->notices();
  for (const std::string& notice : {losses().sentence, topic_->problem()})
    if (!notice.empty()) all.push_back(notice);
  return all;
}

LiveScans::Losses Ros2Source::losses() const {
  const InboxCounts counts = topic_->clouds()->counts();
  return {counts.missing(), missing_sentence(counts)};
}

}  // namespace tilth

// Scans of PointCloud2 messages, whatever hands them over: a bag, or a topic as they come.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tilth/io/recording.hpp>
#include <tilth/messages/ros_message.hpp>
#include <tilth/sources/recorded_source.hpp>

namespace tilth {

/// What it captures it owns.
struct CloudFeed {
  std::string name;                              ///< of the bag or topic
  std::function<std::optional<Message>()> next;  ///< may wait; nothing at the end
  std::function<std::string()> problem = {};     ///< what is damaged, asked at the end; empty: nothing
  Serialization serialization = Serialization::cdr;
  std::optional<std::size_t> size = {};  ///< messages in all, where that is known
  StampTrust trust = StampTrust::judged;
};

/// By the stamps of the messages' headers. `frame` is the frame_id to read; empty: that of the first message. Reads the
/// first messages; those that cannot be read are passed over. Throws Error as RecordedSource does, and where none is in
/// the frame asked for.
std::unique_ptr<RecordedSource> open_clouds(CloudFeed feed, const std::string& frame, const CloudOptions& options,
                                            std::vector<std::string> decisions);

}  // namespace tilth

// Messages of one topic that are in several frames come from several sensors: one of them is read.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tilth {

class FrameChoice {
 public:
  /// `wanted` is the frame_id asked for; empty: that of the first message.
  explicit FrameChoice(std::string wanted) : frame_(wanted), asked_(!wanted.empty()) {}

  /// Whether the message with this frame_id is to be read.
  bool takes(const std::string& frame_id);

  const std::string& frame() const { return frame_; }
  std::size_t taken() const { return taken_; }

  /// What is read, where messages of other frames came; empty: none did.
  std::string decision() const;

  /// Where messages came, but none of the frame asked for: which there are. Empty otherwise.
  std::string problem() const;

  /// What was left out; empty where all are in one frame.
  std::vector<std::string> notices() const;

 private:
  std::string others() const;

  std::string frame_;
  bool asked_ = false;
  std::size_t taken_ = 0;
  std::map<std::string, std::size_t> others_;
};

}  // namespace tilth

#include <tilth/sources/frame_choice.hpp>

namespace tilth {

bool FrameChoice::takes(const std::string& frame_id) {
  if (!asked_ && taken_ == 0 && others_.empty()) frame_ = frame_id;
  const bool taken = frame_id == frame_;
  if (taken)
    ++taken_;
  else
    ++others_[frame_id];
  return taken;
}

std::string FrameChoice::others() const {
  std::string text;
  for (const auto& [frame, count] : others_)
    text += (text.empty() ? "'" : ", '") + frame + "' (" + std::to_string(count) + ")";
  return text;
}

std::string FrameChoice::decision() const {
  if (others_.empty()) return "";
  return "frames: several sensors are on this topic; read are the messages of '" + frame_ + "', --frame chooses";
}

std::string FrameChoice::problem() const {
  if (taken_ > 0 || others_.empty()) return "";
  return "no message of the topic has the frame_id '" + frame_ + "'; there are " + others();
}

std::vector<std::string> FrameChoice::notices() const {
  if (others_.empty()) return {};
  return {"frames: " + std::to_string(taken_) + " messages of '" + frame_ +
          "' were read; left out are those of other sensors on the same topic: " + others() + "; --frame chooses"};
}

}  // namespace tilth

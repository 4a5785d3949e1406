#include <cstdio>

#include <tilth/recording/stamp_findings.hpp>

namespace tilth {
namespace {

constexpr std::size_t kNamed = 3;  ///< findings of a kind told one by one

std::string text(const char* format, double value) {
  char line[64];
  std::snprintf(line, sizeof line, format, value);
  return line;
}

/// `list` with one more entry, if it is among the first.
void add(std::string& list, std::size_t count, const std::string& entry) {
  if (count <= kNamed) list += (list.empty() ? "" : ", ") + entry;
}

std::string more(std::size_t count) {
  return count > kNamed ? " and " + std::to_string(count - kNamed) + " more" : "";
}

}  // namespace

void StampFindings::mended(std::size_t scan, double said, double stamp) {
  if (++mended_ == 1) {
    mended_first_ = "that of scan " + std::to_string(scan) + " was " + text("%.6f s", said) + " and is taken for " +
                    text("%.6f s", stamp);
  }
}

void StampFindings::clock_set(std::size_t scan, double by) {
  add(clocks_set_, ++clocks_,
      (by < 0.0 ? "back by " + text("%.3f s", -by) : "forward by " + text("%.3f s", by)) + " at scan " +
          std::to_string(scan));
}

void StampFindings::put_back(std::size_t scan) {
  add(put_back_first_, ++put_back_, std::to_string(scan));
}

void StampFindings::pause(std::size_t before, double seconds) {
  add(pauses_seen_, ++pauses_, text("%.1f s", seconds) + " after scan " + std::to_string(before));
}

std::vector<std::string> StampFindings::sentences() const {
  std::vector<std::string> all;
  if (mended_ > 0) {
    all.push_back("stamps: " + std::to_string(mended_) + (mended_ == 1 ? " was" : " were") +
                  " mended by the scans before and after; " + mended_first_);
  }
  if (clocks_ > 0) {
    all.push_back("stamps: their clock was set " + clocks_set_ + more(clocks_) +
                  "; the stamps from there on are moved by as much, so that time goes on");
  }
  if (put_back_ > 0) {
    all.push_back("stamps: " + std::to_string(put_back_) + (put_back_ == 1 ? " scan was" : " scans were") +
                  " stored after a later one and put back in order: scan " + put_back_first_ + more(put_back_));
  }
  if (pauses_ > 0) all.push_back("pauses: no scans for " + pauses_seen_ + more(pauses_));
  return all;
}

}  // namespace tilth

// What was found wrong with the stamps of a recording, and what was done about it, as sentences. O(1) a finding.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tilth {

class StampFindings {
 public:
  void mended(std::size_t scan, double said, double stamp);  ///< [s] a stamp that cannot be, and what replaced it
  void clock_set(std::size_t scan, double by);               ///< [s] from `scan` on; the sensor's, evened out
  void put_back(std::size_t scan);                           ///< stored after a later one
  void pause(std::size_t before, double seconds);            ///< after scan `before`; believed

  /// One sentence a kind.
  std::vector<std::string> sentences() const;

 private:
  std::size_t mended_ = 0, clocks_ = 0, put_back_ = 0, pauses_ = 0;
  std::string mended_first_, clocks_set_, put_back_first_, pauses_seen_;
};

}  // namespace tilth

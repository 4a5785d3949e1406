// Scans of a recording: records in, decided upon and decoded, scans out. Whatever stores the records only has to hand
// them over one by one. The next scan is read and decoded in the background while the caller works on this one.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sources/scan_source.hpp>

namespace tilth {

/// One record of a recording.
struct RecordedScan {
  std::size_t index = 0;  ///< in the recording
  std::string where;      ///< file, or bag and message
  StampedRecords records;
  std::string problem;  ///< why there are no records; empty: there are
};

/// Hands over the records in order, nothing at the end. Called from one thread at a time; what it captures it owns.
using RecordReader = std::function<std::optional<RecordedScan>()>;

class RecordedSource : public ScanSource {
 public:
  /// Reads the first records to decide what their fields mean. Throws Error where none of them can be read.
  RecordedSource(RecordReader reader, const RecordingTraits& traits, std::vector<std::string> decisions,
                 std::optional<std::size_t> size);

  void add_contents(std::vector<std::string> lines);  ///< before the fields'

  std::optional<Scan> next() override;
  std::optional<std::size_t> size() const override { return size_; }

 private:
  using Outcome = std::variant<std::monostate, Scan, SkippedScan>;  ///< the end, a scan, or a record passed over

  Outcome decode_next();

  RecordReader reader_;
  std::deque<RecordedScan> first_;  ///< read for the decision, not handed out yet
  std::optional<ScanDecoder> decoder_;
  std::optional<double> last_stamp_;
  std::optional<std::size_t> size_;
  std::future<Outcome> ahead_;  ///< last: its thread uses the members above
};

}  // namespace tilth

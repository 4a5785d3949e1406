// Scans of a recording: records in, decided upon, decoded and put together or cut to whole turns, scans out. Whatever
// stores the records only has to hand them over one by one. The next scan is read and decoded in the background while
// the caller works on this one.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tilth/recording/recording_decoder.hpp>
#include <tilth/recording/stamp_stage.hpp>
#include <tilth/recording/turn_stage.hpp>
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
                 std::optional<std::size_t> size, StampTrust trust = StampTrust::judged);

  void add_contents(std::vector<std::string> lines);  ///< before the fields'

  void add_decision(const std::string& sentence) { decisions_.push_back(sentence); }
  void add_notices(std::function<std::vector<std::string>()> of_reader);  ///< what the reader noticed, told first

  std::optional<Scan> next() override;
  std::optional<std::size_t> size() const override { return size_; }
  std::vector<std::string> notices() const override;

 private:
  using Outcome = std::variant<std::monostate, Scan, SkippedScan>;  ///< the end, a scan, or a record passed over
  struct Origin {
    std::size_t index = 0;  ///< of the record
    std::string where;
  };

  Outcome decode_next();
  void read_on();
  std::vector<Scan> judged_turns();
  void pass_unreadable(std::size_t before);
  void hand_out(std::vector<Scan> turns);
  Outcome in_order(Scan scan, const Origin& origin);
  std::optional<RecordedScan> take();
  void learn_fields(const RecordedScan& record);
  void take_plan();

  RecordReader reader_;
  std::function<std::vector<std::string>()> reader_notices_;
  std::deque<RecordedScan> first_;  ///< read for a decision and mended, not decoded yet
  std::optional<RecordingDecoder> decoder_;
  std::optional<StampStage> stamps_;
  TurnStage turns_;
  std::deque<std::variant<Origin, SkippedScan>> read_;  ///< what went into turns_, or was passed over meanwhile
  std::deque<SkippedScan> unreadable_;                  ///< records whose place among the messages is not reached yet
  std::deque<Outcome> ready_;
  bool ended_ = false, planned_ = false;
  std::optional<double> last_stamp_;
  std::optional<std::size_t> size_;
  std::future<Outcome> ahead_;  ///< last: its thread uses the members above
};

}  // namespace tilth

// The stamps of a recording's messages: which clock they come from is decided over the first ones, then each is judged
// among those before and after it, so that a few messages wait here. O(1) a message beside looking at its bytes once.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/recording/stamp_repair.hpp>
#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sensor/stamp_origin.hpp>

namespace tilth {

/// A decoded message on its way.
struct StampedMessage {
  StampReading reading;
  Scan scan;
  std::string where;     ///< it was recorded
  std::string left_out;  ///< why it is passed over; empty: it is not
};

/// judged: a message waits for some after it, and a stamp that cannot be is replaced. believed: none waits, as suits
/// what comes live, and stamps are taken as they are.
enum class StampTrust : std::uint8_t { judged, believed };

/// What is known of the stamp of record `index`.
StampReading reading_of(std::size_t index, const StampedRecords& records);

class StampStage {
 public:
  /// From the first messages of the recording, at least one.
  explicit StampStage(std::span<const StampReading> first, StampTrust trust = StampTrust::judged);

  const std::string& decision() const { return origin_.sentence; }  ///< empty: the stamps are as recorded
  RecordingTraits traits(RecordingTraits known) const;              ///< with what the stamps are

  /// The stamp of record `index` on the clock that was decided on; it may still be wrong.
  CloudStamp stamp_of(const CloudStamp& recorded, std::size_t index) const;

  /// `records`, which follow one another, with the stamps they get.
  void set_stamps(std::span<StampedRecords> records) const;

  void add(StampedMessage message);  ///< with the reading of its record

  /// The next message in the order of time; nothing while more are needed to judge it. `ended`: there are no more.
  std::optional<StampedMessage> next(bool ended);

  std::vector<std::string> notices() const { return repair_.findings().sentences(); }

 private:
  StampOriginDecision origin_;
  StampRepair repair_;
  std::deque<StampedMessage> waiting_;
  StampTrust trust_;
};

}  // namespace tilth

#include <functional>
#include <string_view>
#include <utility>

#include <tilth/recording/stamp_stage.hpp>

namespace tilth {
namespace {

constexpr double kNominalStep = 0.1;  ///< [s]

/// `first` on the clock that is decided on.
std::vector<StampReading> readings_by(StampOrigin origin, std::span<const StampReading> first) {
  std::vector<StampReading> readings(first.begin(), first.end());
  for (StampReading& reading : readings) {
    if (origin == StampOrigin::recorder) reading.stamp = reading.arrival.value_or(reading.stamp);
    if (origin == StampOrigin::order) reading.stamp = kNominalStep * double(reading.scan);
  }
  return readings;
}

}  // namespace

StampReading reading_of(std::size_t index, const StampedRecords& records) {
  const std::vector<std::byte>& bytes = records.records.bytes;
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return {index, records.stamp.stamp, records.stamp.arrival, std::hash<std::string_view>{}(content)};
}

StampStage::StampStage(std::span<const StampReading> first, StampTrust trust)
    : origin_(decide_stamp_origin(first)), repair_(readings_by(origin_.origin, first)), trust_(trust) {}

RecordingTraits StampStage::traits(RecordingTraits known) const {
  known.end_stamps = origin_.origin == StampOrigin::recorder;
  known.nominal_stamps = known.nominal_stamps || origin_.origin == StampOrigin::order;
  return known;
}

CloudStamp StampStage::stamp_of(const CloudStamp& recorded, std::size_t index) const {
  if (origin_.origin == StampOrigin::recorder) return {recorded.arrival.value_or(recorded.stamp), recorded.arrival};
  if (origin_.origin == StampOrigin::order) return {kNominalStep * double(index), std::nullopt};
  return recorded;
}

void StampStage::set_stamps(std::span<StampedRecords> records) const {
  std::vector<StampReading> readings;
  for (StampedRecords& record : records) readings.push_back(reading_of(readings.size(), record));
  const std::vector<std::optional<double>> stamps = repaired_stamps(readings_by(origin_.origin, readings));
  for (std::size_t k = 0; k < records.size(); ++k) {
    records[k].stamp = stamp_of(records[k].stamp, k);
    if (stamps[k]) records[k].stamp.stamp = *stamps[k];
  }
}

void StampStage::add(StampedMessage message) {
  message.reading.stamp = message.scan.stamp;
  waiting_.push_back(std::move(message));
}

std::optional<StampedMessage> StampStage::next(bool ended) {
  const std::size_t ahead = trust_ == StampTrust::judged && !ended ? StampRepair::kAhead : 0;
  if (waiting_.size() <= ahead) return std::nullopt;
  if (trust_ == StampTrust::believed) {
    StampedMessage first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
  }
  std::vector<StampReading> window;
  for (const StampedMessage& message : waiting_) window.push_back(message.reading);
  StampVerdict verdict = repair_.next(window);
  StampedMessage taken = std::move(waiting_[verdict.take]);
  waiting_.erase(waiting_.begin() + std::ptrdiff_t(verdict.take));
  taken.scan.stamp = verdict.stamp;
  taken.left_out = std::move(verdict.left_out);
  return taken;
}

}  // namespace tilth

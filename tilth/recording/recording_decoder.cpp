#include <algorithm>

#include <tilth/core/error.hpp>
#include <tilth/recording/recording_decoder.hpp>

namespace tilth {
namespace {

std::string described(const char* role, const std::optional<PointField>& field) {
  return std::string(field ? "field '" + field->name + "' (" + name_of(field->type) + ")" : "no field") + " for " +
         role;
}

/// The fields on which rings and times depend; empty where coordinates are missing.
std::string ring_and_time_fields(const PointRecords& records) {
  try {
    const PointFieldRoles roles = roles_of(records);
    return described("rings", roles.ring) + ", " + described("times", roles.time);
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

RecordingDecoder::RecordingDecoder(std::span<StampedRecords> first, const RecordingTraits& traits)
    : traits_(traits), mender_(first, traits) {
  for (StampedRecords& records : first) mend(records);
  const auto readable = std::find_if(first.begin(), first.end(), [](const StampedRecords& stamped) {
    return !ring_and_time_fields(stamped.records).empty();
  });
  learn({readable == first.end() ? first.begin() : readable, first.end()});
  decisions_ = mender_.decisions();
  const std::vector<std::string>& own = layouts_.front().decoder.decisions();
  decisions_.insert(decisions_.end(), own.begin(), own.end());
}

const RecordingDecoder::Layout* RecordingDecoder::find(const PointRecords& records) const {
  const std::string fields = ring_and_time_fields(records);
  const auto it = std::find_if(layouts_.begin(), layouts_.end(), [&](const Layout& l) { return l.fields == fields; });
  return it == layouts_.end() ? nullptr : &*it;
}

bool RecordingDecoder::knows(const StampedRecords& records) const {
  return ring_and_time_fields(records.records).empty() || find(records.records) != nullptr;
}

void RecordingDecoder::learn(std::span<const StampedRecords> records) {
  const std::string fields = ring_and_time_fields(records.front().records);
  std::vector<StampedRecords> alike;
  std::copy_if(records.begin(), records.end(), std::back_inserter(alike),
               [&](const StampedRecords& r) { return ring_and_time_fields(r.records) == fields; });
  RecordingTraits traits = traits_;
  traits.spin_period = turn_duration(records);
  layouts_.push_back({fields, ScanDecoder(alike, traits)});
  if (layouts_.size() == 1) return;
  std::string change = "fields: from scan " + std::to_string(scans_) + " on there is " + fields;
  for (const std::string& decision : layouts_.back().decoder.decisions()) change += "; " + decision;
  changes_.push_back(std::move(change));
}

/// [s] by the first of the records whose times are read; none where no such layout is known yet.
std::optional<double> RecordingDecoder::turn_duration(std::span<const StampedRecords> records) const {
  for (const StampedRecords& stamped : records) {
    const Layout* known = find(stamped.records);
    if (known != nullptr && known->decoder.reads_times()) return known->decoder.turn_duration(stamped);
  }
  return std::nullopt;
}

Scan RecordingDecoder::decode(const StampedRecords& records) {
  ++scans_;
  const Layout* known = find(records.records);
  const ScanDecoder& decoder = known == nullptr ? layouts_.front().decoder : known->decoder;
  Scan scan = decoder.decode(records);
  if (!scan.cloud.has_times()) return untimed(std::move(scan));
  duration_ = *std::max_element(scan.cloud.times.begin(), scan.cloud.times.end());
  if (decoder.reads_times() || traits_.end_stamps)
    lag_ = records.stamp.stamp - scan.stamp;
  else
    scan.stamp -= lag_;
  return scan;
}

/// A scan without times among others with times is stamped by its middle, as their poses are.
Scan RecordingDecoder::untimed(Scan scan) {
  if (duration_ > 0.0) ++untimed_;
  scan.stamp += 0.5 * duration_ - lag_;
  return scan;
}

std::vector<std::string> RecordingDecoder::notices() const {
  std::vector<std::string> all = mender_.notices();
  all.insert(all.end(), changes_.begin(), changes_.end());
  if (untimed_ > 0) {
    all.push_back("times: " + std::to_string(untimed_) + (untimed_ == 1 ? " scan tells" : " scans tell") +
                  " none of its points, while others do: taken at once in the middle of the turn");
  }
  return all;
}

}  // namespace tilth

// The records of one recording -> scans, whose fields may change on the way: each set of ring and time fields has its
// ScanDecoder, decided over the first records that have it. O(n log rings) a scan.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tilth/recording/record_mender.hpp>
#include <tilth/sensor/scan_decoder.hpp>

namespace tilth {

class RecordingDecoder {
 public:
  /// Mends the `first` records, which are to be decoded as they are then, and decides from them. Throws as RecordMender
  /// and ScanDecoder do.
  RecordingDecoder(std::span<StampedRecords> first, const RecordingTraits& traits);

  /// Every other record, before it is decoded.
  void mend(StampedRecords& records) { mender_.mend(records.records); }

  /// Whether these fields have been decided upon.
  bool knows(const StampedRecords& records) const;

  /// Decides upon the fields of the first of these mended records, from all that have the same. Throws as ScanDecoder
  /// does; nothing is decided then.
  void learn(std::span<const StampedRecords> records);

  /// Throws Error where x, y or z is missing or no point is valid. The fields must be known.
  Scan decode(const StampedRecords& records);

  const std::vector<std::string>& decisions() const { return decisions_; }

  /// What was mended, and what changed after the first scans; one sentence each.
  std::vector<std::string> notices() const;

 private:
  struct Layout {
    std::string fields;
    ScanDecoder decoder;
  };

  std::optional<double> turn_duration(std::span<const StampedRecords> records) const;
  const Layout* find(const PointRecords& records) const;
  Scan untimed(Scan scan);

  RecordingTraits traits_;
  RecordMender mender_;
  std::vector<Layout> layouts_;
  std::vector<std::string> decisions_, changes_;
  std::size_t scans_ = 0, untimed_ = 0;
  double duration_ = 0.0;  ///< [s] of the last scan with times
  double lag_ = 0.0;       ///< [s] by which stamps lie after the first point, as times that are read tell
};

}  // namespace tilth

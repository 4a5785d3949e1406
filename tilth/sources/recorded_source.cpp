#include <cmath>
#include <cstdio>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sources/recorded_source.hpp>

namespace tilth {
namespace {

constexpr std::size_t kDecidingScans = 8;

std::string seconds(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.6f s", value);
  return text;
}

std::string fields_line(const PointRecords& records) {
  std::string text;
  for (const PointField& field : records.fields)
    text += (text.empty() ? "fields: " : ", ") + field.name + " " + std::string(name_of(field.type));
  return text + "; " + std::to_string(records.stride) + " bytes a point";
}

/// What keeps a scan out of the order of time, or nothing.
std::string order_problem(double stamp, const std::optional<double>& last) {
  if (!std::isfinite(stamp)) return "its stamp is not finite";
  if (!last || stamp > *last) return "";
  const std::string before = "stamp " + seconds(stamp) + (stamp == *last ? " repeats" : " lies before");
  return before + " that of the scan before it" + (stamp == *last ? "" : ", " + seconds(*last));
}

}  // namespace

RecordedSource::RecordedSource(RecordReader reader, const RecordingTraits& traits, std::vector<std::string> decisions,
                               std::optional<std::size_t> size)
    : reader_(std::move(reader)), size_(size) {
  std::vector<StampedRecords> readable;
  std::string problem;
  while (readable.size() < kDecidingScans) {
    std::optional<RecordedScan> record = reader_();
    if (!record) break;
    if (record->problem.empty())
      readable.push_back(record->records);
    else if (problem.empty())
      problem = record->where + ": " + record->problem;
    first_.push_back(std::move(*record));
  }
  if (readable.empty()) throw Error("recording", problem.empty() ? "holds no scan" : "no scan can be read; " + problem);
  decoder_.emplace(readable, traits);
  contents_.push_back(fields_line(readable.front().records));
  decisions_ = std::move(decisions);
  decisions_.insert(decisions_.end(), decoder_->decisions().begin(), decoder_->decisions().end());
}

void RecordedSource::add_contents(std::vector<std::string> lines) {
  contents_.insert(contents_.begin(), std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
}

std::optional<Scan> RecordedSource::next() {
  while (true) {
    Outcome outcome = ahead_.valid() ? ahead_.get() : decode_next();
    if (std::holds_alternative<std::monostate>(outcome)) return std::nullopt;
    ahead_ = std::async(std::launch::async, [this] { return decode_next(); });
    if (Scan* scan = std::get_if<Scan>(&outcome)) return std::move(*scan);
    skipped_.push_back(std::move(std::get<SkippedScan>(outcome)));
  }
}

RecordedSource::Outcome RecordedSource::decode_next() {
  std::optional<RecordedScan> record;
  if (first_.empty()) {
    record = reader_();
  } else {
    record = std::move(first_.front());
    first_.pop_front();
  }
  if (!record) return std::monostate{};
  if (!record->problem.empty()) return SkippedScan{record->index, record->where, record->problem};
  try {
    Scan scan = decoder_->decode(record->records);
    if (std::string problem = order_problem(scan.stamp, last_stamp_); !problem.empty()) {
      return SkippedScan{record->index, record->where, std::move(problem)};
    }
    last_stamp_ = scan.stamp;
    return scan;
  } catch (const Error& error) {
    return SkippedScan{record->index, record->where, error.what()};
  }
}

}  // namespace tilth

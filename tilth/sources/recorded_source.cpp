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
    : reader_(std::move(reader)), turns_(traits.times == CloudTimes::none), size_(size) {
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
  contents_.push_back(fields_line(readable.front().records));
  decoder_.emplace(readable, traits);
  auto mended = readable.begin();
  for (RecordedScan& record : first_) {
    if (record.problem.empty()) record.records = std::move(*mended++);
  }
  decisions_ = std::move(decisions);
  decisions_.insert(decisions_.end(), decoder_->decisions().begin(), decoder_->decisions().end());
}

void RecordedSource::add_contents(std::vector<std::string> lines) {
  contents_.insert(contents_.begin(), std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
}

void RecordedSource::add_notices(std::function<std::vector<std::string>()> of_reader) {
  reader_notices_ = std::move(of_reader);
}

std::optional<Scan> RecordedSource::next() {
  while (true) {
    Outcome outcome = ahead_.valid() ? ahead_.get() : decode_next();
    take_plan();
    if (std::holds_alternative<std::monostate>(outcome)) return std::nullopt;
    ahead_ = std::async(std::launch::async, [this] { return decode_next(); });
    if (Scan* scan = std::get_if<Scan>(&outcome)) return std::move(*scan);
    skipped_.push_back(std::move(std::get<SkippedScan>(outcome)));
  }
}

/// What the turns of the messages told, once they did. Only while nothing is decoded in the background.
void RecordedSource::take_plan() {
  if (planned_ || !turns_.plan()) return;
  planned_ = true;
  const TurnPlan& plan = *turns_.plan();
  if (plan.kind == TurnPlan::Kind::whole) return;
  decisions_.push_back(plan.sentence);
  if (size_) size_ = std::size_t(double(*size_) / plan.messages);
}

std::vector<std::string> RecordedSource::notices() const {
  if (ahead_.valid()) ahead_.wait();
  std::vector<std::string> all = reader_notices_ ? reader_notices_() : std::vector<std::string>{};
  for (std::string& notice : decoder_->notices()) all.push_back(std::move(notice));
  for (std::string& notice : turns_.notices()) all.push_back(std::move(notice));
  return all;
}

std::optional<RecordedScan> RecordedSource::take() {
  std::optional<RecordedScan> record;
  if (first_.empty()) {
    record = reader_();
    if (record && record->problem.empty()) decoder_->mend(record->records);
  } else {
    record = std::move(first_.front());
    first_.pop_front();
  }
  return record;
}

/// Looks ahead for more records with the fields of `record`.
void RecordedSource::learn_fields(const RecordedScan& record) {
  while (first_.size() + 1 < kDecidingScans) {
    std::optional<RecordedScan> next = reader_();
    if (!next) break;
    if (next->problem.empty()) decoder_->mend(next->records);
    first_.push_back(std::move(*next));
  }
  std::vector<StampedRecords> alike{record.records};
  for (const RecordedScan& next : first_) {
    if (next.problem.empty()) alike.push_back(next.records);
  }
  decoder_->learn(alike);
}

RecordedSource::Outcome RecordedSource::in_order(Scan scan, const Origin& origin) {
  if (std::string problem = order_problem(scan.stamp, last_stamp_); !problem.empty())
    return SkippedScan{origin.index, origin.where, std::move(problem)};
  last_stamp_ = scan.stamp;
  return scan;
}

/// `turns` and what was passed over, in the order of the records. A turn of several messages has the place of the last.
void RecordedSource::hand_out(std::vector<Scan> turns) {
  if (!turns_.plan() && !ended_) return;
  const bool whole = turns_.plan() && turns_.plan()->kind == TurnPlan::Kind::whole;
  Origin origin;
  const auto pass_skipped = [&] {
    for (; !read_.empty() && std::holds_alternative<SkippedScan>(read_.front()); read_.pop_front())
      ready_.push_back(std::get<SkippedScan>(std::move(read_.front())));
  };
  for (Scan& turn : turns) {
    do {
      pass_skipped();
      if (read_.empty()) break;
      origin = std::get<Origin>(std::move(read_.front()));
      read_.pop_front();
    } while (!whole);
    ready_.push_back(in_order(std::move(turn), origin));
  }
  pass_skipped();
  for (; ended_ && !read_.empty(); pass_skipped()) read_.pop_front();
}

void RecordedSource::read_on() {
  const std::optional<RecordedScan> record = take();
  if (!record) {
    ended_ = true;
    return hand_out(turns_.finish());
  }
  std::vector<Scan> turns;
  std::string problem = record->problem;
  if (problem.empty()) {
    try {
      if (!decoder_->knows(record->records)) learn_fields(*record);
      turns = turns_.add(decoder_->decode(record->records));
    } catch (const Error& error) {
      problem = error.what();
    }
  }
  if (problem.empty())
    read_.emplace_back(Origin{record->index, record->where});
  else
    read_.emplace_back(SkippedScan{record->index, record->where, std::move(problem)});
  hand_out(std::move(turns));
}

RecordedSource::Outcome RecordedSource::decode_next() {
  while (ready_.empty() && !ended_) read_on();
  if (ready_.empty()) return std::monostate{};
  Outcome outcome = std::move(ready_.front());
  ready_.pop_front();
  return outcome;
}

}  // namespace tilth

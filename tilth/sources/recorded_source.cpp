#include <limits>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sources/recorded_source.hpp>

namespace tilth {
namespace {

constexpr std::size_t kDecidingScans = 8;
constexpr std::size_t kMostUnreadable = 50;  ///< at the begin of what comes live: then it is said, not waited for ever

std::string fields_line(const PointRecords& records) {
  std::string text;
  for (const PointField& field : records.fields)
    text += (text.empty() ? "fields: " : ", ") + field.name + " " + std::string(name_of(field.type));
  return text + "; " + std::to_string(records.stride) + " bytes a point";
}

}  // namespace

RecordedSource::RecordedSource(RecordReader reader, const RecordingTraits& traits, std::vector<std::string> decisions,
                               std::optional<std::size_t> size, StampTrust trust)
    : reader_(std::move(reader)), turns_(traits.times == CloudTimes::none), size_(size) {
  std::vector<StampedRecords> readable;
  std::vector<StampReading> readings;
  std::string problem;
  while (readable.size() < kDecidingScans) {
    std::optional<RecordedScan> record = reader_();
    if (!record) break;
    if (record->problem.empty())
      readable.push_back(record->records), readings.push_back(reading_of(record->index, record->records));
    else if (problem.empty())
      problem = record->where + ": " + record->problem;
    first_.push_back(std::move(*record));
    if (trust == StampTrust::believed && readable.empty() && first_.size() == kMostUnreadable) break;
  }
  if (readable.empty()) throw Error("recording", problem.empty() ? "holds no scan" : "no scan can be read; " + problem);
  contents_.push_back(fields_line(readable.front().records));
  stamps_.emplace(readings, trust);
  stamps_->set_stamps(readable);
  decoder_.emplace(readable, stamps_->traits(traits));
  auto mended = readable.begin();
  for (RecordedScan& record : first_) {
    if (record.problem.empty()) record.records.records = std::move((mended++)->records);
  }
  decisions_ = std::move(decisions);
  if (!stamps_->decision().empty()) decisions_.push_back(stamps_->decision());
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
  for (std::string& notice : stamps_->notices()) all.push_back(std::move(notice));
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
  stamps_->set_stamps(alike);
  decoder_->learn(alike);
}

RecordedSource::Outcome RecordedSource::in_order(Scan scan, const Origin& origin) {
  if (last_stamp_ && !(scan.stamp > *last_stamp_))
    return SkippedScan{origin.index, origin.where, "its stamp does not lie after that of the scan before it"};
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
  std::optional<RecordedScan> record = take();
  if (!record) {
    ended_ = true;
    std::vector<Scan> turns = judged_turns();
    for (Scan& turn : turns_.finish()) turns.push_back(std::move(turn));
    return hand_out(std::move(turns));
  }
  std::string problem = record->problem;
  if (problem.empty()) {
    try {
      if (!decoder_->knows(record->records)) learn_fields(*record);
      const StampReading reading = reading_of(record->index, record->records);
      record->records.stamp = stamps_->stamp_of(record->records.stamp, record->index);
      stamps_->add({reading, decoder_->decode(record->records), record->where, ""});
    } catch (const Error& error) {
      problem = error.what();
    }
  }
  if (!problem.empty()) unreadable_.push_back({record->index, record->where, std::move(problem)});
  hand_out(judged_turns());
}

/// Of the messages whose stamps can be judged by now.
std::vector<Scan> RecordedSource::judged_turns() {
  std::vector<Scan> turns;
  while (std::optional<StampedMessage> message = stamps_->next(ended_)) {
    pass_unreadable(message->reading.scan);
    if (!message->left_out.empty()) {
      read_.emplace_back(SkippedScan{message->reading.scan, message->where, message->left_out});
      continue;
    }
    read_.emplace_back(Origin{message->reading.scan, message->where});
    for (Scan& turn : turns_.add(std::move(message->scan))) turns.push_back(std::move(turn));
  }
  if (ended_) pass_unreadable(std::numeric_limits<std::size_t>::max());
  return turns;
}

/// Those before this record: stamps are judged some messages later, and what is passed over keeps its place among them.
void RecordedSource::pass_unreadable(std::size_t before) {
  for (; !unreadable_.empty() && unreadable_.front().index < before; unreadable_.pop_front())
    read_.emplace_back(std::move(unreadable_.front()));
}

RecordedSource::Outcome RecordedSource::decode_next() {
  while (ready_.empty() && !ended_) read_on();
  if (ready_.empty()) return std::monostate{};
  Outcome outcome = std::move(ready_.front());
  ready_.pop_front();
  return outcome;
}

}  // namespace tilth

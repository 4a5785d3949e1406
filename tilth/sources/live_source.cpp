#include <chrono>

#include <tilth/core/counted.hpp>
#include <tilth/core/error.hpp>
#include <tilth/sources/live_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

/// The first scan after the backlog finds the queue full of it; it makes no older one give way that was waited for.
constexpr std::chrono::milliseconds kPatienceAfterBacklog{500};

PacketFeed feed_of(const std::shared_ptr<PacketReceiver>& receiver) {
  return {receiver->name(),
          {},
          [receiver] { return receiver->next(); },
          [] { return std::vector<std::string>{}; },
          [receiver] { return receiver->problem(); }};
}

/// The packets of the only sender that the receiver lets through, where one was asked for.
std::unique_ptr<ScanSource> recognise(const std::shared_ptr<PacketReceiver>& receiver, PacketSourceOptions options) {
  options.host.clear();
  try {
    return open_packets(feed_of(receiver), options);
  } catch (const Error&) {
    const ReceiverCounts counts = receiver->counts();
    if (counts.received > 0) throw;
    if (const std::string problem = receiver->problem(); !problem.empty()) throw Error(receiver->name(), problem);
    throw Error(receiver->name(), "no packet came (" + std::to_string(counts.foreign) +
                                      " of other senders): is the sensor set to send to this computer and port, and "
                                      "does no firewall keep UDP out?");
  }
}

}  // namespace

LiveSource::LiveSource(std::unique_ptr<PacketReceiver> receiver, const LiveOptions& options)
    : receiver_(std::move(receiver)), packets_(recognise(receiver_, options.packets)), queue_(options.queue) {
  contents_ = packets_->contents();
  decisions_ = packets_->decisions();
  receiver_->expect_backlog();
  decoder_ = std::jthread([this] { decode(); });
}

LiveSource::~LiveSource() {
  receiver_->stop();
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  changed_.notify_all();
}

void LiveSource::decode() {
  std::string problem;
  try {
    while (std::optional<Scan> scan = packets_->next()) hand_over(std::move(*scan));
  } catch (const std::exception& error) {
    problem = error.what();
  }
  const std::lock_guard lock(mutex_);
  if (!problem.empty()) newly_skipped_.push_back({scans_, receiver_->name(), problem});
  const std::vector<SkippedScan>& skipped = packets_->skipped();
  newly_skipped_.insert(newly_skipped_.end(), skipped.begin() + std::ptrdiff_t(skipped_before_), skipped.end());
  packet_notices_ = packets_->notices();
  ended_ = true;
  changed_.notify_all();
}

void LiveSource::wait_for_room(std::unique_lock<std::mutex>& lock) {
  const bool patient = !receiver_->caught_up() || receiver_->ended();  // after the end nothing newer comes
  const auto room = [&] { return waiting_.size() < queue_ || stopping_; };
  if (patient)
    changed_.wait(lock, room);
  else if (backlog_waits_)
    changed_.wait_for(lock, kPatienceAfterBacklog, room);
  backlog_waits_ = patient;
}

void LiveSource::hand_over(Scan scan) {
  std::unique_lock lock(mutex_);
  wait_for_room(lock);
  if (waiting_.size() >= queue_) {
    waiting_.pop_front();
    ++dropped_;
  }
  waiting_.push_back(std::move(scan));
  ++scans_;
  const std::vector<SkippedScan>& skipped = packets_->skipped();
  newly_skipped_.insert(newly_skipped_.end(), skipped.begin() + std::ptrdiff_t(skipped_before_), skipped.end());
  skipped_before_ = skipped.size();
  packet_notices_ = packets_->notices();
  changed_.notify_all();
}

std::optional<Scan> LiveSource::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !waiting_.empty() || ended_; });
  skipped_.insert(skipped_.end(), newly_skipped_.begin(), newly_skipped_.end());
  newly_skipped_.clear();
  if (waiting_.empty()) return std::nullopt;
  std::optional<Scan> scan(std::move(waiting_.front()));
  waiting_.pop_front();
  changed_.notify_all();
  return scan;
}

std::vector<std::string> LiveSource::notices() const {
  const LiveCounts c = counts();
  std::vector<std::string> all;
  const auto tell = [&](std::size_t n, const std::string& noun, const std::string& rest) {
    if (n > 0) all.push_back(counted(n, noun) + " " + rest);
  };
  tell(c.dropped, "scan", "of " + std::to_string(c.scans) + " dropped: registration was too slow for them");
  tell(c.packets.dropped, "packet", "dropped: too many waited to be decoded");
  tell(c.packets.system_dropped, "packet", "dropped by the system: its buffer was full");
  tell(c.packets.foreign, "packet", "of other senders left out");
  const std::lock_guard lock(mutex_);
  all.insert(all.begin(), packet_notices_.begin(), packet_notices_.end());
  return all;
}

LiveScans::Losses LiveSource::losses() const {
  const LiveCounts c = counts();
  const std::size_t packets = c.packets.dropped + c.packets.system_dropped;
  if (c.dropped + packets == 0) return {};
  return {c.dropped + packets, "this computer is too slow: " + std::to_string(c.dropped) + " of " +
                                   std::to_string(c.scans) + " scans and " + std::to_string(packets) +
                                   " packets dropped so far"};
}

LiveCounts LiveSource::counts() const {
  const ReceiverCounts packets = receiver_->counts();
  const bool caught_up = receiver_->caught_up();
  const std::lock_guard lock(mutex_);
  return {packets, scans_, dropped_, caught_up};
}

LiveAddress parse_live_uri(const std::string& uri, const OptionValues& values) {
  constexpr std::uint16_t kSensorPort = 2368;
  if (!uri.starts_with(kLiveScheme)) throw Error(uri, "is no live source: expected udp://[ADDRESS]:PORT");
  SourceUri source = parse_source_uri(uri.substr(kLiveScheme.size()));
  source.values.insert(values.begin(), values.end());
  return {source.what.empty() ? UdpAddress{0, kSensorPort} : parse_udp_address(source.what),
          options_of<LiveOptions>("packets of a sensor", source.values)};
}

std::unique_ptr<PacketReceiver> listen(const LiveAddress& address, std::function<bool()> stopped) {
  const std::string& host = address.options.packets.host;
  return std::make_unique<PacketReceiver>(address.local, host.empty() ? 0 : parse_ipv4(host), address.options.receiver,
                                          std::move(stopped));
}

}  // namespace tilth

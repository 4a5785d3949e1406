#include <exception>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/sources/packet_receiver.hpp>

namespace tilth {
namespace {

constexpr std::chrono::milliseconds kPatience{100};

}  // namespace

PacketReceiver::PacketReceiver(const UdpAddress& local, std::uint32_t sender, const ReceiverOptions& options,
                               std::function<bool()> stopped)
    : sender_(sender), options_(options), stopped_(std::move(stopped)) {
  sockets_.push_back(opened(local));
  name_ = "udp://" + address_text(local.host) + ":" + std::to_string(port());
  const bool last_port = options.device_port == 0 && port() == 65535;
  if (!last_port)
    listen_for_device_packets(local, std::uint16_t(options.device_port != 0 ? options.device_port : port() + 1));
  system_dropped_.resize(sockets_.size());
  for (std::size_t i = 0; i < sockets_.size(); ++i)
    threads_.emplace_back([this, i](const std::stop_token& token) { receive(i, token); });
}

PacketReceiver::~PacketReceiver() {
  stop();
}

/// Datagrams to a group come to sockets that are bound to it, by the interface that has the local address.
UdpSocket PacketReceiver::opened(const UdpAddress& local) const {
  if (options_.multicast.empty()) return UdpSocket::listening(local);
  const std::uint32_t group = parse_ipv4(options_.multicast);
  UdpSocket socket = UdpSocket::listening({group, local.port});
  socket.join(group, local.host);
  return socket;
}

void PacketReceiver::listen_for_device_packets(const UdpAddress& local, std::uint16_t port) {
  try {
    sockets_.push_back(opened({local.host, port}));
  } catch (const Error& error) {
    warning_ = std::string(error.what()) + "; a Leishen's device packets are missed";
  }
}

void PacketReceiver::stop() {
  for (std::jthread& thread : threads_) thread.request_stop();
  const std::lock_guard lock(mutex_);
  ended_ = true;
  queue_.clear();
  arrived_.notify_all();
}

void PacketReceiver::receive(std::size_t socket, const std::stop_token& token) {
  try {
    while (!token.stop_requested() && !done()) {
      std::optional<UdpDatagram> datagram = sockets_[socket].receive(kPatience);
      if (!datagram) continue;
      const std::lock_guard lock(mutex_);
      system_dropped_[socket] = sockets_[socket].dropped();
      take(std::move(*datagram));
    }
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    problem_ = error.what();
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  arrived_.notify_all();
}

/// Called with the lock held.
void PacketReceiver::take(UdpDatagram datagram) {
  if (sender_ != 0 && datagram.sender.host != sender_) {
    ++counts_.foreign;
    return;
  }
  last_ = Clock::now();
  ++counts_.received;
  if (queue_.size() >= options_.buffer) {
    ++counts_.dropped;
    return;
  }
  queue_.push_back({datagram.arrival, datagram.sender.host, std::move(datagram.payload)});
  arrived_.notify_one();
}

bool PacketReceiver::done() const {
  if (stopped_ && stopped_()) return true;
  const std::lock_guard lock(mutex_);
  const std::chrono::duration<double> silence = Clock::now() - last_;
  return ended_ || (options_.idle > 0.0 && silence.count() > options_.idle);
}

std::optional<ReceivedPacket> PacketReceiver::next() {
  std::unique_lock lock(mutex_);
  if (queue_.empty()) caught_up_ = true;
  arrived_.wait(lock, [&] { return !queue_.empty() || ended_; });
  if (queue_.empty()) return std::nullopt;
  std::optional<ReceivedPacket> packet(std::move(queue_.front()));
  queue_.pop_front();
  return packet;
}

bool PacketReceiver::caught_up() const {
  const std::lock_guard lock(mutex_);
  return caught_up_;
}

bool PacketReceiver::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

void PacketReceiver::expect_backlog() {
  const std::lock_guard lock(mutex_);
  caught_up_ = false;
}

ReceiverCounts PacketReceiver::counts() const {
  const std::lock_guard lock(mutex_);
  ReceiverCounts counts = counts_;
  for (const std::uint64_t dropped : system_dropped_) counts.system_dropped += std::size_t(dropped);
  return counts;
}

std::string PacketReceiver::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

}  // namespace tilth

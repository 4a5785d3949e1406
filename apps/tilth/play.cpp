// tilth play: sends recorded or simulated packets as their sensor does.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "interrupt.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/sensor/packet.hpp>
#include <tilth/sources/packet_feeds.hpp>
#include <tilth/sources/udp_socket.hpp>

namespace tilth::app {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

struct PlayArguments {
  std::string source, to, topic;
  double rate = 1.0;
  bool quiet = false;
};

/// Holds the packets to the times at which they were sent, `rate` times as fast.
class Pace {
 public:
  explicit Pace(double rate) : rate_(rate) {}

  /// Waits until it is time; what lies before the last one goes at once.
  void wait(double arrival) {
    if (!begun_) first_ = arrival, begin_ = Clock::now();
    begun_ = true;
    const auto due = begin_ + std::chrono::duration_cast<Clock::duration>(Seconds((arrival - first_) / rate_));
    std::this_thread::sleep_until(due);
    latest_ = std::max(latest_, Seconds(Clock::now() - due));
  }

  double seconds() const { return begun_ ? Seconds(Clock::now() - begin_).count() : 0.0; }
  double latest() const { return latest_.count(); }  ///< [s] that a packet was late at most

 private:
  double rate_;
  bool begun_ = false;
  double first_ = 0.0;
  Clock::time_point begin_;
  Seconds latest_{0.0};
};

/// Device packets go to the next port, position packets as far off as a Velodyne sends them.
std::uint16_t port_of(PacketKind kind, const UdpAddress& to) {
  const int beside = kind == PacketKind::device ? 1 : kind == PacketKind::position ? 8308 - 2368 : 0;
  const int port = int(to.port) + beside;
  return std::uint16_t(port <= 65535 ? port : to.port);
}

std::string summary(std::size_t sent, const Pace& pace, const std::string& to) {
  char text[192];
  std::snprintf(text, sizeof text, "%zu packets sent to %s in %.2f s; the latest was %.1f ms late", sent, to.c_str(),
                pace.seconds(), 1e3 * pace.latest());
  return text;
}

int play(const PlayArguments& arguments) {
  const UdpAddress to = parse_udp_address(arguments.to);
  if (to.host == 0) throw Error("--to " + arguments.to, "names no computer: expected HOST:PORT, as 127.0.0.1:2368");
  const PacketFeed feed = open_packet_feed(arguments.source, arguments.topic);
  UdpSocket socket = UdpSocket::sending();
  Console console(arguments.quiet);
  remember_interrupts();
  Pace pace(arguments.rate);
  std::size_t sent = 0, other = 0;
  while (interrupted() == 0) {
    const std::optional<ReceivedPacket> packet = feed.next();
    if (!packet) break;
    const PacketKind kind = kind_of(packet->payload);
    if (kind == PacketKind::other) {
      ++other;
      continue;
    }
    pace.wait(packet->arrival.value_or(0.0));
    socket.send({to.host, port_of(kind, to)}, packet->payload);
    ++sent;
  }
  if (!feed.problem().empty()) console.warn(feed.name + " is damaged: " + feed.problem());
  for (const std::string& notice : feed.notices()) console.note(notice);
  if (other > 0) console.warn(std::to_string(other) + " datagrams that are no known packets were left out");
  console.note(summary(sent, pace, address_text(to.host) + ":" + std::to_string(to.port)));
  if (interrupted() != 0) return signal_exit_code();
  return sent > 0 ? 0 : 1;
}

}  // namespace

void add_play(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("play", "Send recorded or simulated packets as their sensor does");
  const auto arguments = std::make_shared<PlayArguments>();
  command->add_option("SOURCE", arguments->source, "network capture, bag with packets, bare payloads or sim://SCENE")
      ->required();
  command->add_option("--to", arguments->to, "HOST:PORT; device packets go to the next port")->required();
  command->add_option("--rate", arguments->rate, "times as fast as recorded (1)")->check(CLI::Range(1e-3, 1e3));
  command->add_option("--topic", arguments->topic, "of a bag with several topics of packets");
  command->add_flag("--quiet", arguments->quiet, "print errors only");
  command->callback([arguments, &exit_code] { exit_code = play(*arguments); });
}

}  // namespace tilth::app

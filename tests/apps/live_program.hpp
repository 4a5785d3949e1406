// tilth play and tilth live, over the loopback, as tests start them.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "program.hpp"
#include <tilth/sources/udp_socket.hpp>

namespace tilth::app {

class Live : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  void record(const std::string& sensor, const std::string& duration) const {
    ASSERT_EQ(tilth({"simulate", "plaza_fast", "--out", in("sim"), "--format", "pcap", "--sensor", sensor, "--duration",
                     duration, "--quiet"})
                  .exit_code,
              0);
  }

  /// Starts tilth live and waits until it listens.
  std::unique_ptr<Program> live(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> arguments{"live", "udp://" + address(), "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto program = std::make_unique<Program>(arguments);
    while (program->running() && program->out_so_far().empty()) rest();
    return program;
  }

  std::vector<std::string> play(const std::string& rate) const {
    return {"play", in("sim/scans.pcap"), "--to", address(), "--rate", rate};
  }

  std::size_t poses_in(const std::string& out) const {
    const std::string text = text_of(folder_ / out / "trajectory.tum");
    return lines_in(text);
  }

  static void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

  TemporaryFolder folder_;
  std::uint16_t port_ = UdpSocket::listening({0x7F000001, 0}).port();
};

}  // namespace tilth::app

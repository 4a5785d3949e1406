// A server for those who watch a run: a page of our own, and Foxglove's WebSocket protocol, at one port. It runs in a
// thread of its own and never makes the caller wait: what comes too fast for a client is left out there
// (client_feed.hpp). It reads no file, and takes nothing from a client but what it wants to see.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <tilth/run/run_messages.hpp>

namespace tilth {

struct ViewAddress {
  std::string host = "127.0.0.1";  ///< an address of this machine; 0.0.0.0 or :: for all
  std::uint16_t port = 8765;       ///< 0: any that is free
};

class ViewServer {
 public:
  /// `name` is shown to clients. Where the port is taken, any that is free. Throws Error where the host is no address
  /// of this machine.
  ViewServer(const ViewAddress& address, const std::string& name);

  /// Clients that read get what waits for them, for a second at most.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  std::uint16_t port() const;

  /// Whether anybody is subscribed to it.
  bool wanted(RunTopic topic) const;

  /// Hands `message` (CDR) of the stamp [s] to all who are subscribed; who subscribes later gets the last one at once.
  void send(RunTopic topic, double stamp, std::vector<std::byte> message);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tilth

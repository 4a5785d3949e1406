// What the connections of a view server share. All of it belongs to the server's thread, but for `wanted`.
#pragma once

#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tilth/view/client_feed.hpp>

namespace tilth {

/// A client of the WebSocket.
class ViewClient {
 public:
  virtual ~ViewClient() = default;
  virtual const ClientFeed& feed() const = 0;
  virtual void offer(const ViewMessage& message) = 0;
  virtual void finish() = 0;  ///< closes the connection when nothing waits any more
};

struct ViewHub {
  std::string page, page_policy;       ///< HTML, and its Content-Security-Policy
  std::vector<std::string> greetings;  ///< to each client
  std::vector<ViewClient*> clients;
  std::size_t connections = 0;  ///< those that only fetch the page included
  std::array<std::optional<ViewMessage>, kRunTopics> last;
  std::array<std::atomic<bool>, kRunTopics> wanted{};

  void recount();
};

/// Serves whoever is at the other end of the socket, as long as it stays. `hub` outlives the connection.
void serve(boost::asio::ip::tcp::socket socket, ViewHub& hub);

}  // namespace tilth

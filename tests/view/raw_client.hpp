// A client that sends any bytes whatever, as a browser does not.
#pragma once

#include <arpa/inet.h>
#include <cstdint>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

#include <tilth/view/view_server.hpp>

namespace tilth {

class RawClient {
 public:
  explicit RawClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~RawClient() { ::close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool connected() const { return connected_; }
  void send(const std::string& bytes) const { (void)!::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  void send_no_more() const { ::shutdown(socket_, SHUT_WR); }

  /// What comes until `end` is in it, the other side is done, or nothing came for `patience` [ms].
  std::string receive(const std::string& end = "", int patience = 5000) const {
    std::string all;
    while (end.empty() || all.find(end) == std::string::npos) {
      pollfd waiting{socket_, POLLIN, 0};
      if (::poll(&waiting, 1, patience) <= 0) break;
      char buffer[65536];
      const ssize_t got = ::recv(socket_, buffer, sizeof buffer, 0);
      if (got <= 0) break;
      all.append(buffer, std::size_t(got));
    }
    return all;
  }

 private:
  int socket_;
  bool connected_ = false;
};

inline std::string handshake(const std::string& more = "", const std::string& protocol = "foxglove.websocket.v1") {
  return "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Protocol: " +
         protocol + "\r\n" + more + "\r\n";
}

inline std::string client_frame(const std::string& payload, unsigned char first = 0x81);

/// Opens a WebSocket, takes the greetings and asks for these channels, each under its own number.
inline void subscribe(const RawClient& client, const std::string& channels) {
  client.send(handshake());
  client.receive("advertise");
  std::string list;
  for (const char c : channels)
    list.append(list.empty() ? "" : ",")
        .append("{\"id\":")
        .append(1, c)
        .append(",\"channelId\":")
        .append(1, c)
        .append("}");
  client.send(client_frame("{\"op\":\"subscribe\",\"subscriptions\":[" + list + "]}"));
}

/// Waits until somebody is subscribed to it, or nobody any more; five seconds at most.
inline bool becomes_wanted(const ViewServer& server, RunTopic topic, bool wanted = true) {
  for (int i = 0; i < 500 && server.wanted(topic) != wanted; ++i) ::usleep(10'000);
  return server.wanted(topic) == wanted;
}

/// A frame of a client, masked with zeros (RFC 6455, 5.2); `first` is its first byte: 0x81 for a text.
inline std::string client_frame(const std::string& payload, unsigned char first) {
  std::string frame{char(first)};
  const std::size_t size = payload.size();
  const int bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;  // of its length
  frame += char(0x80 | (bytes == 0 ? size : bytes == 2 ? 126 : 127));
  for (int i = bytes - 1; i >= 0; --i) frame += char(std::uint64_t(size) >> (8 * i) & 0xFF);
  return frame + std::string(4, '\0') + payload;
}

}  // namespace tilth

// A UDP socket of IPv4, as a sensor and its receiver use it. POSIX; the times of arrival and the datagrams that the
// system dropped are told by Linux itself (SO_TIMESTAMPNS, SO_RXQ_OVFL).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilth {

struct UdpAddress {
  std::uint32_t host = 0;  ///< IPv4, its first number in the highest byte; 0: every one of this computer
  std::uint16_t port = 0;
};

/// "127.0.0.1:2368", "localhost:2368", ":2368" (host 0). Throws Error naming what is missing or unknown.
UdpAddress parse_udp_address(const std::string& text);

/// "192.168.1.200" or the address of a name. Throws Error where there is none.
std::uint32_t parse_ipv4(const std::string& text);

struct UdpDatagram {
  double arrival = 0.0;  ///< [s] since 1970
  UdpAddress sender;
  std::vector<std::byte> payload;
};

/// Every failure throws Error with the address and the system's reason.
class UdpSocket {
 public:
  /// Listens at `local`; port 0: any that is free.
  static UdpSocket listening(const UdpAddress& local);
  static UdpSocket sending();

  ~UdpSocket();
  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&&) = delete;

  void join(std::uint32_t group, std::uint32_t interface_address);  ///< a multicast group, by the interface with it
  std::uint16_t port() const;

  /// The next datagram; nothing where none came within `patience`.
  std::optional<UdpDatagram> receive(std::chrono::milliseconds patience);
  void send(const UdpAddress& to, std::span<const std::byte> payload);

  std::uint64_t dropped() const { return dropped_; }  ///< datagrams that the system had no room for, so far

 private:
  explicit UdpSocket(std::string name);
  void option(int level, int name, int value);
  [[noreturn]] void refuse(const std::string& what) const;

  std::string name_;
  int descriptor_ = -1;
  std::uint64_t dropped_ = 0;
};

}  // namespace tilth

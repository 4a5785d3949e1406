#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/sources/udp_socket.hpp>

namespace tilth {
namespace {

constexpr int kReceiveBuffer = 8 << 20;           // [bytes] asked for; the system may give less
constexpr std::size_t kLargestDatagram = 65'535;  // [bytes]

sockaddr_in to_system(const UdpAddress& address) {
  sockaddr_in system{};
  system.sin_family = AF_INET;
  system.sin_port = htons(address.port);
  system.sin_addr.s_addr = htonl(address.host);
  return system;
}

/// What the system says beside a datagram.
template <class T>
std::optional<T> told(msghdr& message, int type) {
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != type) continue;
    T value{};
    std::memcpy(&value, CMSG_DATA(c), sizeof value);
    return value;
  }
  return std::nullopt;
}

double seconds_of(const timespec& time) {
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

double now() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return seconds_of(time);
}

}  // namespace

std::uint32_t parse_ipv4(const std::string& text) {
  addrinfo wanted{}, *raw = nullptr;
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  const int result = ::getaddrinfo(text.c_str(), nullptr, &wanted, &raw);
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> found(raw, ::freeaddrinfo);
  if (text.empty() || result != 0 || !found)
    throw Error("address " + text, "is no IPv4 address or known name: " + std::string(::gai_strerror(result)));
  sockaddr_in system{};
  std::memcpy(&system, found->ai_addr, sizeof system);
  return ntohl(system.sin_addr.s_addr);
}

UdpAddress parse_udp_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? "" : text.substr(colon + 1);
  UdpAddress address;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (port.empty() || error != std::errc{} || end != port.data() + port.size())
    throw Error("address " + text, "has no port in 0 .. 65535: expected HOST:PORT, as 127.0.0.1:2368");
  if (colon > 0) address.host = parse_ipv4(text.substr(0, colon));
  return address;
}

UdpSocket::UdpSocket(std::string name)
    : name_(std::move(name)), descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (descriptor_ < 0) refuse("cannot be opened");
}

UdpSocket::~UdpSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : name_(std::move(other.name_)), descriptor_(std::exchange(other.descriptor_, -1)), dropped_(other.dropped_) {}

UdpSocket UdpSocket::listening(const UdpAddress& local) {
  UdpSocket socket("udp://" + address_text(local.host) + ":" + std::to_string(local.port));
  socket.option(SOL_SOCKET, SO_TIMESTAMPNS, 1);
  socket.option(SOL_SOCKET, SO_RXQ_OVFL, 1);
  socket.option(SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
  const sockaddr_in system = to_system(local);
  if (::bind(socket.descriptor_, reinterpret_cast<const sockaddr*>(&system), sizeof system) != 0)
    socket.refuse("cannot be listened at");
  return socket;
}

UdpSocket UdpSocket::sending() {
  UdpSocket socket("udp");
  socket.option(SOL_SOCKET, SO_BROADCAST, 1);
  return socket;
}

void UdpSocket::join(std::uint32_t group, std::uint32_t interface_address) {
  ip_mreq request{};
  request.imr_multiaddr.s_addr = htonl(group);
  request.imr_interface.s_addr = htonl(interface_address);
  if (::setsockopt(descriptor_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0)
    refuse("cannot join the multicast group " + address_text(group));
}

std::uint16_t UdpSocket::port() const {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  if (::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&system), &size) != 0) refuse("has no port");
  return ntohs(system.sin_port);
}

std::optional<UdpDatagram> UdpSocket::receive(std::chrono::milliseconds patience) {
  pollfd waiting{descriptor_, POLLIN, 0};
  const int ready = ::poll(&waiting, 1, int(patience.count()));
  if (ready == 0 || (ready < 0 && errno == EINTR)) return std::nullopt;
  if (ready < 0) refuse("cannot be read");
  thread_local std::vector<std::byte> buffer(kLargestDatagram);
  alignas(cmsghdr) std::array<std::byte, 256> told_beside{};
  sockaddr_in system{};
  iovec part{buffer.data(), buffer.size()};
  msghdr message{&system, sizeof system, &part, 1, told_beside.data(), told_beside.size(), 0};
  const ssize_t size = ::recvmsg(descriptor_, &message, MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EINTR || errno == ECONNREFUSED)) return std::nullopt;
  if (size < 0) refuse("cannot be read");
  if (const auto drops = told<std::uint32_t>(message, SO_RXQ_OVFL)) dropped_ = *drops;
  const auto arrival = told<timespec>(message, SCM_TIMESTAMPNS);
  return UdpDatagram{arrival ? seconds_of(*arrival) : now(),
                     {ntohl(system.sin_addr.s_addr), ntohs(system.sin_port)},
                     {buffer.begin(), buffer.begin() + size}};
}

void UdpSocket::send(const UdpAddress& to, std::span<const std::byte> payload) {
  const sockaddr_in system = to_system(to);
  ssize_t sent = -1;
  do {
    sent = ::sendto(descriptor_, payload.data(), payload.size(), 0, reinterpret_cast<const sockaddr*>(&system),
                    sizeof system);
  } while (sent < 0 && (errno == EINTR || errno == ECONNREFUSED));
  if (sent >= 0) return;
  name_ = address_text(to.host) + ":" + std::to_string(to.port);
  refuse("cannot be sent to");
}

void UdpSocket::option(int level, int name, int value) {
  if (::setsockopt(descriptor_, level, name, &value, sizeof value) != 0) refuse("cannot be set up");
}

void UdpSocket::refuse(const std::string& what) const {
  throw Error(name_, what + ": " + std::generic_category().message(errno));
}

}  // namespace tilth

#include <algorithm>
#include <utility>

#include <tilth/io/ip_fragments.hpp>

namespace tilth::pcap {
namespace {

constexpr std::size_t kMostOpen = 16, kLargest = 65535, kGrain = 8;

}  // namespace

std::list<IpFragments::Datagram>::iterator IpFragments::find(const Ipv4Packet& fragment) {
  const auto found = std::find_if(open_.begin(), open_.end(), [&](const Datagram& d) {
    return d.source == fragment.source && d.destination == fragment.destination && d.id == fragment.id;
  });
  if (found != open_.end()) return found;
  if (open_.size() == kMostOpen) open_.pop_front();
  return open_.insert(open_.end(), Datagram{fragment.source, fragment.destination, fragment.id, {}, {}, {}});
}

std::optional<std::vector<std::byte>> IpFragments::add(const Ipv4Packet& fragment) {
  const std::size_t end = fragment.offset + fragment.payload.size();
  const bool ragged = fragment.more_fragments && fragment.payload.size() % kGrain != 0;
  if (end > kLargest || ragged || fragment.payload.empty()) return std::nullopt;
  const auto datagram = find(fragment);
  if (datagram->bytes.size() < end) {
    datagram->bytes.resize(end);
    datagram->there.resize((end + kGrain - 1) / kGrain, false);
  }
  std::copy(fragment.payload.begin(), fragment.payload.end(),
            datagram->bytes.begin() + std::ptrdiff_t(fragment.offset));
  const auto grain = [&](std::size_t byte) { return datagram->there.begin() + std::ptrdiff_t(byte / kGrain); };
  std::fill(grain(fragment.offset), grain(end + kGrain - 1), true);
  if (!fragment.more_fragments) datagram->size = end;
  const bool whole = datagram->size == datagram->bytes.size() &&
                     std::all_of(datagram->there.begin(), datagram->there.end(), [](bool there) { return there; });
  if (!whole) return std::nullopt;
  std::vector<std::byte> bytes = std::move(datagram->bytes);
  open_.erase(datagram);
  return bytes;
}

}  // namespace tilth::pcap

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <pcap/pcap.h>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/ip_fragments.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/io/udp_frame.hpp>

namespace tilth {
namespace {

using pcap::Link;

struct CaptureCloser {
  void operator()(pcap_t* capture) const { pcap_close(capture); }
};

Link link_of(int type) {
  switch (type) {
    case DLT_EN10MB: return Link::ethernet;
    case DLT_LINUX_SLL: return Link::linux_cooked;
    case DLT_LINUX_SLL2: return Link::linux_cooked_2;
    case DLT_RAW:
    case DLT_IPV4: return Link::raw_ip;
    case DLT_NULL:
    case DLT_LOOP: return Link::loopback;
    default: return Link::unknown;
  }
}

}  // namespace

struct PcapReader::State {
  std::string name;
  std::unique_ptr<pcap_t, CaptureCloser> capture;
  Link link = Link::unknown;
  pcap::IpFragments fragments;
  PcapCounts counts;
  std::string problem;

  State(std::FILE* file, std::string file_name) : name(std::move(file_name)) {
    if (file == nullptr) throw Error(name, "cannot be read: " + std::string(std::strerror(errno)));
    char reason[PCAP_ERRBUF_SIZE] = "";
    capture.reset(pcap_fopen_offline_with_tstamp_precision(file, PCAP_TSTAMP_PRECISION_NANO, reason));
    if (!capture) {
      std::fclose(file);
      throw Error(name, "is no network capture that can be read: " + std::string(reason));
    }
    link = link_of(pcap_datalink(capture.get()));
    if (link == Link::unknown) {
      throw Error(name, "captures a link of type " + std::to_string(pcap_datalink(capture.get())) +
                            "; known are Ethernet, Linux cooked, raw IP and loopback");
    }
  }

  /// The datagram in a frame, where it holds one or completes one.
  std::optional<Datagram> take(std::span<const std::byte> bytes) {
    const pcap::Frame frame = parse_frame(link, bytes);
    if (frame.kind != pcap::FrameKind::udp) {
      ++(frame.kind == pcap::FrameKind::cut ? counts.cut : counts.other);
      return std::nullopt;
    }
    std::optional<std::vector<std::byte>> assembled;
    if (frame.packet.is_fragment()) {
      ++counts.fragments;
      assembled = fragments.add(frame.packet);
      if (!assembled) return std::nullopt;
    }
    const auto udp = pcap::parse_udp(assembled ? std::span<const std::byte>(*assembled) : frame.packet.payload);
    if (!udp) {
      ++counts.cut;
      return std::nullopt;
    }
    ++counts.datagrams;
    return Datagram{
        0.0, frame.packet.source, udp->source_port, udp->destination_port, {udp->payload.begin(), udp->payload.end()}};
  }
};

std::string address_text(std::uint32_t a) {
  char text[16];
  std::snprintf(text, sizeof text, "%u.%u.%u.%u", a >> 24, a >> 16 & 0xFF, a >> 8 & 0xFF, a & 0xFF);
  return text;
}

PcapReader::PcapReader(const std::filesystem::path& path)
    : state_(std::make_unique<State>(std::fopen(path.c_str(), "rbe"), path.string())) {}

PcapReader::PcapReader(std::span<const std::byte> memory, const std::string& name) {
  if (memory.empty()) throw Error(name, "is empty");
  void* const bytes = const_cast<std::byte*>(memory.data());  // opened for reading only
  state_ = std::make_unique<State>(fmemopen(bytes, memory.size(), "rb"), name);
}

PcapReader::~PcapReader() = default;
PcapReader::PcapReader(PcapReader&&) noexcept = default;

std::optional<Datagram> PcapReader::next() {
  State& s = *state_;
  while (s.problem.empty()) {
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    const int result = pcap_next_ex(s.capture.get(), &header, &bytes);
    if (result == PCAP_ERROR_BREAK) return std::nullopt;
    if (result != 1) {
      s.problem = "frame " + std::to_string(s.counts.frames) + ": " + pcap_geterr(s.capture.get());
      return std::nullopt;
    }
    ++s.counts.frames;
    std::optional<Datagram> datagram = s.take(std::as_bytes(std::span(bytes, header->caplen)));
    if (!datagram) continue;
    datagram->arrival = double(header->ts.tv_sec) + double(header->ts.tv_usec) * 1e-9;
    return datagram;
  }
  return std::nullopt;
}

const PcapCounts& PcapReader::counts() const {
  return state_->counts;
}

const std::string& PcapReader::problem() const {
  return state_->problem;
}

}  // namespace tilth

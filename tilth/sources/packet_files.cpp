#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/sources/packet_files.hpp>

namespace tilth {
namespace {

constexpr std::array<std::size_t, 2> kPayloadSizes{1206, 1212};
constexpr std::size_t kBlockBytes = 100;
constexpr std::uint64_t kReadAtOnce = 1 << 20;

bool begins_packet(std::span<const std::byte> bytes) {
  if (bytes.size() < kPayloadSizes.front()) return false;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (bytes[block * kBlockBytes] != std::byte(0xFF) || bytes[block * kBlockBytes + 1] != std::byte(0xEE))
      return false;
  }
  return true;
}

/// Walks through a file of payloads; each is as long as the one before, unless the next begins elsewhere.
class PayloadReader {
 public:
  explicit PayloadReader(InputFile file) : file_(std::move(file)) {}

  std::optional<ReceivedPacket> next() {
    while (fill() && window().size() >= size_) {
      const bool another = window().size() == size_ || begins_packet(window().subspan(size_));
      if (begins_packet(window()) && (another || size_ == kPayloadSizes.back())) {
        ReceivedPacket packet{std::nullopt, 0, {window().begin(), window().begin() + std::ptrdiff_t(size_)}};
        at_ += size_;
        return packet;
      }
      resynchronise();
    }
    skipped_ += window().size();
    at_ += window().size();
    return std::nullopt;
  }

  std::uint64_t skipped() const { return skipped_; }

 private:
  std::span<const std::byte> window() const { return std::span(bytes_).subspan(at_); }

  /// Whether there are bytes; at least two packets of them, where the file has as many.
  bool fill() {
    if (window().size() < 2 * kPayloadSizes.back() && position_ < file_.size()) {
      const std::vector<std::byte> more = file_.read(position_, kReadAtOnce);
      position_ += more.size();
      bytes_.erase(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(at_));
      bytes_.insert(bytes_.end(), more.begin(), more.end());
      at_ = 0;
    }
    return !window().empty();
  }

  /// The other length where a packet begins here, else the next byte.
  void resynchronise() {
    if (begins_packet(window()) && size_ == kPayloadSizes.front()) {
      size_ = kPayloadSizes.back();
      return;
    }
    size_ = kPayloadSizes.front();
    ++at_, ++skipped_;
  }

  InputFile file_;
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0, size_ = kPayloadSizes.front();
  std::uint64_t position_ = 0, skipped_ = 0;
};

std::vector<std::string> notices_of(const PcapCounts& counts) {
  std::vector<std::string> all;
  const auto tell = [&](std::size_t n, const std::string& what) {
    if (n > 0) all.push_back(std::to_string(n) + " of " + std::to_string(counts.frames) + " captured frames " + what);
  };
  tell(counts.other, "are other traffic");
  tell(counts.cut, "are cut short and left out");
  tell(counts.fragments, "are fragments of datagrams");
  return all;
}

}  // namespace

bool is_capture(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension == ".pcap" || extension == ".pcapng" || extension == ".cap";
}

bool is_payload_file(const std::filesystem::path& path) {
  return begins_packet(InputFile(path).read(0, kPayloadSizes.front()));
}

PacketFeed capture_feed(const std::filesystem::path& path) {
  const auto capture = std::make_shared<PcapReader>(path);
  return {path.string(),
          [capture]() -> std::optional<ReceivedPacket> {
            std::optional<Datagram> datagram = capture->next();
            if (!datagram) return std::nullopt;
            return ReceivedPacket{datagram->arrival, datagram->source, std::move(datagram->payload)};
          },
          [capture] { return notices_of(capture->counts()); }, [capture] { return capture->problem(); }};
}

PacketFeed payload_feed(const std::filesystem::path& path) {
  const auto reader = std::make_shared<PayloadReader>(InputFile(path));
  return {path.string(), [reader] { return reader->next(); }, [] { return std::vector<std::string>{}; },
          [reader] {
            if (reader->skipped() == 0) return std::string{};
            return std::to_string(reader->skipped()) + " bytes belong to no packet";
          }};
}

}  // namespace tilth

#include <array>

#include <tilth/io/payload_file.hpp>

namespace tilth {
namespace {

constexpr std::array<std::size_t, 2> kSizes{1206, 1212};
constexpr std::size_t kBlocks = 12, kBlockSize = 100;
constexpr std::uint64_t kReadAtOnce = 1 << 20;

bool begins_payload(std::span<const std::byte> bytes) {
  if (bytes.size() < kSizes.front()) return false;
  for (std::size_t at = 0; at < kBlocks * kBlockSize; at += kBlockSize) {
    if (bytes[at] != std::byte(0xFF) || bytes[at + 1] != std::byte(0xEE)) return false;
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::byte>> PayloadFileReader::next() {
  while (fill() && window().size() >= size_) {
    const bool followed = window().size() == size_ || begins_payload(window().subspan(size_));
    if (begins_payload(window()) && (followed || size_ == kSizes.back())) {
      const std::span<const std::byte> payload = window().first(size_);
      at_ += size_;
      return std::vector<std::byte>(payload.begin(), payload.end());
    }
    resynchronise();
  }
  skipped_ += window().size();
  at_ = bytes_.size();
  return std::nullopt;
}

/// Whether there are bytes; at least two payloads of them, where the file has as many.
bool PayloadFileReader::fill() {
  if (window().size() < 2 * kSizes.back() && position_ < file_.size()) {
    const std::vector<std::byte> more = file_.read(position_, kReadAtOnce);
    position_ = more.empty() ? file_.size() : position_ + more.size();
    bytes_.erase(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(at_));
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    at_ = 0;
  }
  return !window().empty();
}

/// The other size where a payload begins here, else the next byte.
void PayloadFileReader::resynchronise() {
  if (begins_payload(window()) && size_ == kSizes.front() && window().size() >= kSizes.back()) {
    size_ = kSizes.back();
    return;
  }
  size_ = kSizes.front();
  ++at_, ++skipped_;
}

bool is_payload_file(const std::filesystem::path& path) {
  return begins_payload(InputFile(path).read(0, kSizes.front()));
}

}  // namespace tilth

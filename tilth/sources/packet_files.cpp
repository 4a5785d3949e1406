#include <utility>

#include <tilth/io/file_kind.hpp>
#include <tilth/io/payload_file.hpp>
#include <tilth/io/pcap.hpp>
#include <tilth/sources/packet_files.hpp>

namespace tilth {
namespace {

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
  const std::string extension = kind_of_file(path);
  return extension == ".pcap" || extension == ".pcapng" || extension == ".cap";
}

PacketFeed capture_feed(const std::filesystem::path& path) {
  const auto capture = std::make_shared<PcapReader>(path);
  return {path.string(),
          {},
          [capture]() -> std::optional<ReceivedPacket> {
            std::optional<Datagram> datagram = capture->next();
            if (!datagram) return std::nullopt;
            return ReceivedPacket{datagram->arrival, datagram->source, std::move(datagram->payload)};
          },
          [capture] { return notices_of(capture->counts()); },
          [capture] { return capture->problem(); },
          path};
}

PacketFeed payload_feed(const std::filesystem::path& path) {
  const auto file = std::make_shared<PayloadFileReader>(InputFile(path));
  return {path.string(),
          {},
          [file]() -> std::optional<ReceivedPacket> {
            std::optional<std::vector<std::byte>> payload = file->next();
            return payload ? std::optional(ReceivedPacket{std::nullopt, 0, std::move(*payload)}) : std::nullopt;
          },
          [] { return std::vector<std::string>{}; },
          [file] {
            return file->skipped() == 0 ? std::string{}
                                        : std::to_string(file->skipped()) + " bytes belong to no packet";
          }};
}

}  // namespace tilth

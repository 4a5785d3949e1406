// Files of packets: network captures (pcap, pcapng), and bare payloads one after the other.
#pragma once

#include <filesystem>

#include <tilth/sources/packet_source.hpp>

namespace tilth {

/// .pcap, .pcapng or .cap, in upper or lower case.
bool is_capture(const std::filesystem::path& path);

PacketFeed capture_feed(const std::filesystem::path& path);  ///< throws Error as PcapReader

/// Bytes between payloads are passed over and counted. Throws Error as InputFile.
PacketFeed payload_feed(const std::filesystem::path& path);

}  // namespace tilth

// Files of packets: network captures (pcap, pcapng), and bare payloads one after the other.
#pragma once

#include <filesystem>

#include <tilth/sources/packet_source.hpp>

namespace tilth {

/// .pcap, .pcapng or .cap, in upper or lower case.
bool is_capture(const std::filesystem::path& path);

/// The file begins with the payload of a data packet.
bool is_payload_file(const std::filesystem::path& path);

PacketFeed capture_feed(const std::filesystem::path& path);  ///< throws Error as PcapReader

/// Bytes between payloads are passed over and counted.
PacketFeed payload_feed(const std::filesystem::path& path);

}  // namespace tilth

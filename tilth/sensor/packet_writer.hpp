// Numbers, blocks and stamps put into the payload of a packet: what packet.hpp takes apart again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tilth/sensor/packet.hpp>

namespace tilth {

using PacketBytes = std::vector<std::byte>;

void put_little(PacketBytes& bytes, std::size_t at, std::uint64_t value, std::size_t size);
void put_big(PacketBytes& bytes, std::size_t at, std::uint64_t value, std::size_t size);

/// What stands before the blocks, but for the time.
void put_header(PacketBytes& payload, const PacketFormat& format);

/// `azimuth` [0.01 deg] and the shots of one block.
void put_block(PacketBytes& payload, const PacketLayout& layout, std::size_t block, double azimuth,
               std::span<const PacketEcho> shots);

/// The time that the packet tells [s] since 1970, return mode (strongest) and model. Before 2000 no date is told.
void put_tail(PacketBytes& payload, const PacketFormat& format, double stamp);

}  // namespace tilth

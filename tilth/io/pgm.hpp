// Portable grey map (Netpbm PGM, binary, 8 bits a pixel).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace tilth {

/// Writes `pixels`, row after row from the top. Throws Error where the file cannot be written in full.
void write_pgm(const std::filesystem::path& path, int columns, std::span<const std::uint8_t> pixels);

}  // namespace tilth

#include <string>

#include <tilth/io/output_file.hpp>
#include <tilth/io/pgm.hpp>

namespace tilth {

void write_pgm(const std::filesystem::path& path, int columns, std::span<const std::uint8_t> pixels) {
  const std::size_t rows = columns > 0 ? pixels.size() / std::size_t(columns) : 0;
  OutputFile file(path);
  file.write("P5\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n255\n");
  file.write(std::as_bytes(pixels));
  file.close();
}

}  // namespace tilth

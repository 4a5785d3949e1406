#include <algorithm>
#include <utility>

#include <bzlib.h>
#include <lz4frame.h>

#include <tilth/core/error.hpp>
#include <tilth/io/rosbag1_chunk.hpp>

namespace tilth::rosbag1 {
namespace {

constexpr std::size_t kStep = 1 << 18;  // [bytes] unpacked at once

class Lz4Stream {
 public:
  Lz4Stream() { LZ4F_createDecompressionContext(&context_, LZ4F_VERSION); }
  ~Lz4Stream() { LZ4F_freeDecompressionContext(context_); }
  Lz4Stream(const Lz4Stream&) = delete;
  Lz4Stream& operator=(const Lz4Stream&) = delete;

  bool ended() const { return ended_; }

  // Takes from `in`, gives the bytes written to `out`; negative: damaged.
  std::ptrdiff_t step(std::span<const std::byte>& in, std::span<std::byte> out) {
    std::size_t given = out.size(), taken = in.size();
    const std::size_t hint = LZ4F_decompress(context_, out.data(), &given, in.data(), &taken, nullptr);
    if (LZ4F_isError(hint)) return -1;
    in = in.subspan(taken);
    ended_ = hint == 0;
    return std::ptrdiff_t(given);
  }

 private:
  LZ4F_dctx* context_ = nullptr;
  bool ended_ = false;
};

class Bz2Stream {
 public:
  Bz2Stream() { BZ2_bzDecompressInit(&stream_, 0, 0); }
  ~Bz2Stream() { BZ2_bzDecompressEnd(&stream_); }
  Bz2Stream(const Bz2Stream&) = delete;
  Bz2Stream& operator=(const Bz2Stream&) = delete;

  bool ended() const { return ended_; }

  std::ptrdiff_t step(std::span<const std::byte>& in, std::span<std::byte> out) {
    stream_.next_in = const_cast<char*>(as_text(in).data());  // bzlib's pointer is not const, its bytes are left alone
    stream_.avail_in = unsigned(in.size());
    stream_.next_out = reinterpret_cast<char*>(out.data());
    stream_.avail_out = unsigned(out.size());
    const int result = BZ2_bzDecompress(&stream_);
    if (result != BZ_OK && result != BZ_STREAM_END) return -1;
    ended_ = result == BZ_STREAM_END;
    in = in.last(stream_.avail_in);
    return std::ptrdiff_t(out.size() - stream_.avail_out);
  }

 private:
  bz_stream stream_{};
  bool ended_ = false;
};

// One byte more than `size` is asked for, so that a stream which holds more shows.
template <class Stream>
void unpack(std::span<const std::byte> packed, std::uint64_t size, Chunk& chunk) {
  Stream stream;
  std::size_t done = 0;
  while (!stream.ended() && done <= size) {
    chunk.bytes.resize(std::min<std::size_t>(done + kStep, size + 1));
    const std::size_t before = packed.size();
    const std::ptrdiff_t given = stream.step(packed, std::span(chunk.bytes).subspan(done));
    if (given < 0)
      chunk.problem = "its compressed data is corrupt";
    else if (given == 0 && packed.size() == before && !stream.ended())
      chunk.problem = "its compressed data breaks off";
    if (!chunk.problem.empty()) break;
    done += std::size_t(given);
  }
  chunk.bytes.resize(std::min<std::size_t>(done, size));
  if (chunk.problem.empty() && done != size) {
    chunk.problem = "it holds another number of bytes than the " + std::to_string(size) + " that it states";
  }
}

}  // namespace

Chunk read_chunk(const InputFile& file, const Record& record) {
  const std::string_view compression = record.text("compression");
  const std::uint64_t stated = record.field<std::uint32_t>("size").value_or(0);
  const bool unclosed = stated == 0 && record.data_size == 0 && compression != "none";
  const std::uint64_t stored = unclosed ? file.size() - std::min(file.size(), record.data_position) : record.data_size;
  Chunk chunk{record.position, {}, {}};
  if (stated > kMaxChunk || stored > kMaxChunk) {
    chunk.problem = "it states more than " + std::to_string(kMaxChunk) + " bytes";
    return chunk;
  }
  std::vector<std::byte> bytes = file.read(record.data_position, stored);
  const bool cut = bytes.size() < stored;
  if (compression == "none")
    chunk.bytes = std::move(bytes);
  else if (compression == "bz2")
    unpack<Bz2Stream>(bytes, unclosed ? kMaxChunk : stated, chunk);
  else if (compression == "lz4")
    unpack<Lz4Stream>(bytes, unclosed ? kMaxChunk : stated, chunk);
  else
    chunk.problem = "its compression '" + std::string(compression.substr(0, 20)) + "' is none of none, bz2, lz4";
  if (cut || unclosed) chunk.problem = "the file ends inside it";
  return chunk;
}

std::string pack_lz4(std::string_view bytes) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.blockMode = LZ4F_blockIndependent;
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string packed(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  const std::size_t size = LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), &preferences);
  if (LZ4F_isError(size)) throw Error("lz4", LZ4F_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace tilth::rosbag1

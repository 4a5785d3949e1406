#include <memory>
#include <zstd.h>

#include <lz4frame.h>

#include <tilth/core/error.hpp>
#include <tilth/io/unpack.hpp>

namespace tilth {
namespace {

using Bytes = std::vector<std::byte>;
constexpr std::size_t kStep = 1 << 18;  // [bytes] unpacked at once

/// Calls step(in, out) -> bytes given, taking from `in`, until it says it has ended; nothing where it fails or stalls.
template <class Step>
std::optional<Bytes> unpack_steps(std::span<const std::byte> in, const Step& step) {
  Bytes bytes;
  std::size_t done = 0;
  for (bool ended = false; !ended;) {
    if (done >= kMostUnpacked) return std::nullopt;
    bytes.resize(done + kStep);
    const std::size_t left = in.size();
    const std::optional<std::size_t> given = step(in, std::span(bytes).subspan(done), ended);
    const bool stalls = given && *given == 0 && in.size() == left && !ended;
    if (!given || stalls) return std::nullopt;
    done += *given;
  }
  bytes.resize(done);
  return bytes;
}

std::optional<Bytes> unpack_lz4(std::span<const std::byte> packed) {
  LZ4F_dctx* raw = nullptr;
  LZ4F_createDecompressionContext(&raw, LZ4F_VERSION);
  const std::unique_ptr<LZ4F_dctx, std::size_t (*)(LZ4F_dctx*)> context(raw, LZ4F_freeDecompressionContext);
  const auto step = [&](std::span<const std::byte>& in, std::span<std::byte> out,
                        bool& ended) -> std::optional<std::size_t> {
    std::size_t given = out.size(), taken = in.size();
    const std::size_t hint = LZ4F_decompress(context.get(), out.data(), &given, in.data(), &taken, nullptr);
    if (LZ4F_isError(hint) != 0) return std::nullopt;
    in = in.subspan(taken);
    ended = hint == 0;
    return given;
  };
  return unpack_steps(packed, step);
}

std::optional<Bytes> unpack_zstd(std::span<const std::byte> packed) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  const auto step = [&](std::span<const std::byte>& in, std::span<std::byte> out,
                        bool& ended) -> std::optional<std::size_t> {
    ZSTD_inBuffer input{in.data(), in.size(), 0};
    ZSTD_outBuffer output{out.data(), out.size(), 0};
    const std::size_t hint = ZSTD_decompressStream(context.get(), &output, &input);
    if (ZSTD_isError(hint) != 0) return std::nullopt;
    in = in.subspan(input.pos);
    ended = hint == 0;
    return output.pos;
  };
  return unpack_steps(packed, step);
}

}  // namespace

bool is_zstd(std::span<const std::byte> bytes) {
  constexpr std::array<unsigned char, 4> kMagic{0x28, 0xB5, 0x2F, 0xFD};
  return bytes.size() >= kMagic.size() &&
         std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                    [](unsigned char a, std::byte b) { return a == std::to_integer<unsigned char>(b); });
}

std::optional<Bytes> unpack(std::string_view compression, std::span<const std::byte> packed) {
  if (compression == "lz4") return unpack_lz4(packed);
  if (compression == "zstd") return unpack_zstd(packed);
  if (!compression.empty() || packed.size() > kMostUnpacked) return std::nullopt;
  return Bytes(packed.begin(), packed.end());
}

bool unpack_zstd_file(const InputFile& packed, const std::function<void(std::span<const std::byte>)>& take) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  Bytes plain(kStep);
  std::size_t hint = 1;
  for (std::uint64_t position = 0; position < packed.size();) {
    const Bytes bytes = packed.read(position, kStep);
    if (bytes.empty()) return false;
    position += bytes.size();
    ZSTD_inBuffer input{bytes.data(), bytes.size(), 0};
    bool full = false;  // there may be more to give though all was taken
    while (input.pos < input.size || full) {
      ZSTD_outBuffer output{plain.data(), plain.size(), 0};
      hint = ZSTD_decompressStream(context.get(), &output, &input);
      if (ZSTD_isError(hint) != 0) return false;
      take(std::span(plain).first(output.pos));
      full = output.pos == output.size && hint != 0;
    }
  }
  return hint == 0;
}

Bytes pack_zstd(std::span<const std::byte> plain) {
  constexpr int kFast = 1;
  Bytes packed(ZSTD_compressBound(plain.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), kFast);
  if (ZSTD_isError(size) != 0) throw Error("zstd", ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace tilth

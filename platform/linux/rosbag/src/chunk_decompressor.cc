// SPDX-License-Identifier: BSD-3-Clause
#include "chunk_decompressor.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>

#include "bag_reader.h"
#include "disflow/posix/shown_text.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

Fault Damaged(const char* compression) {
  return MakeFault(Status::kCorrupt, "its %s data are damaged", compression);
}

Fault DecompressLz4(std::span<const std::uint8_t> packed, std::span<std::uint8_t> unpacked) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0)
    return MakeFault(Status::kIoError, "no memory to unpack lz4");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, LZ4F_freeDecompressionContext);
  std::size_t left = 1;
  while (left != 0) {
    std::size_t written = unpacked.size();
    std::size_t read = packed.size();
    left = LZ4F_decompress(context, unpacked.data(), &written, packed.data(), &read, nullptr);
    if (LZ4F_isError(left) != 0 || (written == 0 && read == 0)) return Damaged("lz4");
    unpacked = unpacked.subspan(written);
    packed = packed.subspan(read);
  }
  return unpacked.empty() ? Fault{} : Damaged("lz4");
}

Fault DecompressZstd(std::span<const std::uint8_t> packed, std::span<std::uint8_t> unpacked) {
  const std::size_t size =
      ZSTD_decompress(unpacked.data(), unpacked.size(), packed.data(), packed.size());
  return ZSTD_isError(size) == 0 && size == unpacked.size() ? Fault{} : Damaged("zstd");
}

Fault DecompressBzip2(std::span<const std::uint8_t> packed, std::span<std::uint8_t> unpacked) {
  auto size = static_cast<unsigned>(unpacked.size());
  // Its interface is older than const; it writes to the other side alone.
  auto* const from = reinterpret_cast<char*>(const_cast<std::uint8_t*>(packed.data()));
  const int result = BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(unpacked.data()), &size,
                                                from, static_cast<unsigned>(packed.size()),
                                                /*small=*/0, /*verbosity=*/0);
  return result == BZ_OK && size == unpacked.size() ? Fault{} : Damaged("bz2");
}

}  // namespace

Fault Decompress(std::string_view compression, std::span<const std::uint8_t> packed,
                 std::vector<std::uint8_t>& unpacked) {
  if (compression == "lz4") return DecompressLz4(packed, unpacked);
  if (compression == "bz2") return DecompressBzip2(packed, unpacked);
  if (compression == "zstd") return DecompressZstd(packed, unpacked);
  if (!compression.empty()) {
    return MakeFault(Status::kUnsupported, "is packed with '%s'; lz4, zstd and bz2 can be read",
                     ShownText(compression, 20).c_str());
  }
  if (packed.size() != unpacked.size()) return Damaged("unpacked");
  std::copy(packed.begin(), packed.end(), unpacked.begin());
  return {};
}

Fault DecompressMessage(std::vector<std::uint8_t>& unpacked, std::span<std::uint8_t>& message,
                        UnpackedTotal& total, std::uint64_t read_bytes) {
  // No message of CDR begins so: its first byte is zero.
  constexpr std::array<std::uint8_t, 4> kZstd{0x28, 0xB5, 0x2F, 0xFD};
  if (message.size() < kZstd.size() || !std::equal(kZstd.begin(), kZstd.end(), message.begin()))
    return {};
  const unsigned long long size = ZSTD_getFrameContentSize(message.data(), message.size());
  // What is not known, or no frame at all, is a number beyond all bounds.
  if (size > kMostMessageBytes) return Damaged("zstd");
  if (!total.Add(size, read_bytes)) return MakeFault(Status::kCorrupt, UnpackedTotal::kRefusal);
  unpacked.resize(static_cast<std::size_t>(size));
  const Fault fault = DecompressZstd(message, unpacked);
  message = unpacked;
  return fault;
}

}  // namespace disflow::posix

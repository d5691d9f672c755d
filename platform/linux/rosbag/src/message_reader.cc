// SPDX-License-Identifier: BSD-3-Clause
#include "message_reader.h"

namespace disflow::posix {

static_assert(std::endian::native == std::endian::little, "messages are read by a small machine");

MessageReader::MessageReader(Serialization serialization, std::span<std::uint8_t> message) noexcept
    : body_(message) {
  if (serialization == Serialization::kRos1) {
    aligned_ = false;
    return;
  }
  // Two bytes of representation, big endian or little, and two of options; alignment counts from
  // behind them.
  constexpr std::size_t kHead = 4;
  ok_ = message.size() >= kHead && message[0] == 0 && message[1] <= 1;
  if (!ok_) return;
  swap_ = message[1] == 0;
  body_ = message.subspan(kHead);
}

void MessageReader::Align(std::size_t size) noexcept {
  if (aligned_) at_ = (at_ + size - 1) / size * size;
}

std::span<std::uint8_t> MessageReader::TakeBytes(std::size_t count) noexcept {
  ok_ = ok_ && at_ <= body_.size() && count <= body_.size() - at_;
  if (!ok_) return {};
  const auto bytes = body_.subspan(at_, count);
  at_ += count;
  return bytes;
}

std::string_view MessageReader::TakeText() noexcept {
  const auto bytes = TakeByteSequence();
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // CDR counts a zero at the end.
  if (text.ends_with('\0')) text.remove_suffix(1);
  return text;
}

std::span<std::uint8_t> MessageReader::TakeByteSequence() noexcept {
  const auto count = Take<std::uint32_t>();
  return TakeBytes(count);
}

}  // namespace disflow::posix

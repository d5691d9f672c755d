// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/frame_decoder.h"

#include <algorithm>
#include <cstring>

#include "disflow/hal/mavlink/known_messages.h"
#include "disflow/saturating.h"

namespace disflow::hal::mavlink {
std::size_t FrameDecoder::Feed(std::span<const std::byte> bytes) noexcept {
  if (begin_ > 0) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
  }
  const std::size_t taken = std::min(bytes.size(), buffer_.size() - end_);
  std::copy_n(bytes.begin(), taken, buffer_.begin() + static_cast<std::ptrdiff_t>(end_));
  end_ += taken;
  return taken;
}

bool FrameDecoder::Next(FrameView& frame, SigningSession* session) noexcept {
  while (begin_ < end_) {
    std::size_t frame_size = 0;
    switch (Examine(frame_size)) {
      case Verdict::kIncomplete:
        return false;
      case Verdict::kGarbage:
        SkipToMagic();
        break;
      case Verdict::kFrame:
        if (session != nullptr && !IsAuthentic(*session, frame_size)) break;
        AddSaturating(counters_.frames);
        frame.header = {.sequence = At(4), .system_id = At(5), .component_id = At(6)};
        frame.message_id = MessageId();
        frame.is_signed = (At(2) & kFlagSigned) != 0;
        frame.payload = std::span(buffer_).subspan(begin_ + kHeaderSize, At(1));
        begin_ += frame_size;
        return true;
    }
  }
  return false;
}

/// @return false if the frame was refused; it is counted and passed over then.
bool FrameDecoder::IsAuthentic(SigningSession& session, std::size_t frame_size) noexcept {
  switch (session.Check(std::span<const std::byte>(buffer_).subspan(begin_, frame_size))) {
    case SignatureVerdict::kAccepted:
      return true;
    case SignatureVerdict::kWrong:
      AddSaturating(counters_.wrong_signature);
      // The checksum says nothing of the signature's bytes: they may be the frame that follows one
      // that was cut off.
      SkipToMagic();
      return false;
    case SignatureVerdict::kUnsigned:
      AddSaturating(counters_.without_signature);
      break;
    case SignatureVerdict::kReplayed:
      AddSaturating(counters_.replayed);
      break;
    case SignatureVerdict::kOutdated:
      AddSaturating(counters_.outdated);
      break;
    case SignatureVerdict::kNoRoom:
      AddSaturating(counters_.streams_refused);
      break;
  }
  AddSaturating(counters_.skipped_bytes, static_cast<std::uint32_t>(frame_size));
  begin_ += frame_size;
  return false;
}

/// To the next byte that may begin a frame: most bytes on a shared link are of no use here.
void FrameDecoder::SkipToMagic() noexcept {
  const std::byte* const from = buffer_.data() + begin_;
  const void* const found = std::memchr(from + 1, kMagic, end_ - begin_ - 1);
  const std::size_t skipped =
      found == nullptr ? end_ - begin_
                       : static_cast<std::size_t>(static_cast<const std::byte*>(found) - from);
  AddSaturating(counters_.skipped_bytes, static_cast<std::uint32_t>(skipped));
  begin_ += skipped;
}

FrameDecoder::Verdict FrameDecoder::Examine(std::size_t& frame_size) noexcept {
  if (At(0) != kMagic) return Verdict::kGarbage;
  if (end_ - begin_ < kHeaderSize) return Verdict::kIncomplete;
  if ((At(2) & ~kFlagSigned) != 0) {
    AddSaturating(counters_.unsupported_flags);
    return Verdict::kGarbage;
  }
  const Expected<std::uint8_t> crc_extra = CrcExtraOf(MessageId());
  if (!crc_extra.ok()) {
    // Its checksum cannot be verified, so its length cannot be trusted to skip over it.
    AddSaturating(counters_.unknown_id);
    return Verdict::kGarbage;
  }
  const std::size_t payload_end = kHeaderSize + At(1);
  frame_size = payload_end + kChecksumSize + ((At(2) & kFlagSigned) != 0 ? kSignatureSize : 0);
  if (end_ - begin_ < frame_size) return Verdict::kIncomplete;

  Crc crc;
  crc.Add(std::span<const std::byte>(buffer_).subspan(begin_ + 1, payload_end - 1));
  crc.Add(crc_extra.value);
  const auto received = std::span<const std::byte>(buffer_).subspan(begin_ + payload_end);
  if (crc.value() == LoadLittleEndian<std::uint16_t>(received)) return Verdict::kFrame;
  AddSaturating(counters_.bad_checksum);
  return Verdict::kGarbage;
}

}  // namespace disflow::hal::mavlink

// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/signing_session.h"

#include "disflow/hal/little_endian.h"
#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/known_messages.h"
#include "disflow/hal/secret.h"
#include "disflow/hal/sha256.h"

namespace disflow::hal::mavlink {
namespace {

// Behind the checksum: number of the link, time, signature.
constexpr std::size_t kTimeSize = 6;
constexpr std::size_t kStampSize = 1 + kTimeSize;

void StoreTime(SigningTime time, std::span<std::byte> out) noexcept {
  std::array<std::byte, sizeof(SigningTime)> bytes;
  StoreLittleEndian(time, bytes);
  std::copy_n(bytes.begin(), kTimeSize, out.begin());
}

std::uint8_t ByteAt(std::span<const std::byte> frame, std::size_t offset) noexcept {
  return std::to_integer<std::uint8_t>(frame[offset]);
}

/// @return The message's CRC_EXTRA, if this is a whole unsigned frame of a known one.
Expected<std::uint8_t> CrcExtraOfUnsigned(std::span<const std::byte> frame) noexcept {
  constexpr Expected<std::uint8_t> kNone{0, Status::kUnsupported};
  if (frame.size() < kHeaderSize + kChecksumSize || ByteAt(frame, 0) != kMagic) return kNone;
  if (ByteAt(frame, 2) != 0) return kNone;
  if (frame.size() != kHeaderSize + ByteAt(frame, 1) + kChecksumSize) return kNone;
  return CrcExtraOf(MessageIdOf(frame));
}

}  // namespace

SigningSession::~SigningSession() { Wipe(key_); }

bool SigningSession::HasKey(const SigningKey& key) const noexcept {
  return EqualInConstantTime(key_, key);
}

Expected<std::size_t> SigningSession::Sign(std::span<const std::byte> frame, std::uint8_t link_id,
                                           std::span<std::byte> out) noexcept {
  const Expected<std::uint8_t> crc_extra = CrcExtraOfUnsigned(frame);
  if (!crc_extra.ok()) return {0, crc_extra.status};
  const std::size_t size = frame.size() + kSignatureSize;
  if (out.size() < size || time_ >= kMaxSigningTime) return {0, Status::kCapacityExceeded};
  ++time_;

  std::copy(frame.begin(), frame.end(), out.begin());
  out[2] = std::byte{kFlagSigned};
  // The flag is under the checksum, too.
  const std::size_t payload_end = frame.size() - kChecksumSize;
  Crc crc;
  crc.Add(out.subspan(1, payload_end - 1));
  crc.Add(crc_extra.value);
  StoreLittleEndian(crc.value(), out.subspan(payload_end));

  out[frame.size()] = std::byte{link_id};
  StoreTime(time_, out.subspan(frame.size() + 1));
  const std::size_t signed_size = frame.size() + kStampSize;
  const Signature signature = SignatureOf(out.first(signed_size));
  std::copy(signature.begin(), signature.end(),
            out.begin() + static_cast<std::ptrdiff_t>(signed_size));
  return {size};
}

SignatureVerdict SigningSession::Check(std::span<const std::byte> frame) noexcept {
  if ((ByteAt(frame, 2) & kFlagSigned) == 0) return SignatureVerdict::kUnsigned;
  const std::size_t signed_size = frame.size() - kSignatureBytes;
  const Signature expected = SignatureOf(frame.first(signed_size));
  if (!EqualInConstantTime(expected, frame.subspan(signed_size))) return SignatureVerdict::kWrong;

  const std::size_t stamp_at = signed_size - kStampSize;
  return CheckTime({.system_id = ByteAt(frame, 5),
                    .component_id = ByteAt(frame, 6),
                    .link_id = ByteAt(frame, stamp_at),
                    .time = LoadLittleEndian<SigningTime>(frame.subspan(stamp_at + 1, kTimeSize))});
}

SignatureVerdict SigningSession::CheckTime(const Stream& claimed) noexcept {
  if (own_system_id_ != 0 && claimed.system_id == own_system_id_) {
    return SignatureVerdict::kReplayed;
  }
  Stream* const known = std::find_if(streams_.begin(), streams_.end(), [&](const Stream& stream) {
    return stream.system_id == claimed.system_id && stream.component_id == claimed.component_id &&
           stream.link_id == claimed.link_id;
  });
  const bool is_new = known == streams_.end();
  if (!is_new && claimed.time <= known->time) return SignatureVerdict::kReplayed;
  if (claimed.time + kSigningMinute < time_) return SignatureVerdict::kOutdated;
  if (!is_new) {
    known->time = claimed.time;
  } else if (!streams_.push_back(claimed)) {
    return SignatureVerdict::kNoRoom;
  }
  time_ = std::max(time_, claimed.time);
  return SignatureVerdict::kAccepted;
}

SigningSession::Signature SigningSession::SignatureOf(
    std::span<const std::byte> signed_part) const noexcept {
  Sha256 sha256;
  sha256.Add(key_);
  sha256.Add(signed_part);
  const Sha256::Digest digest = sha256.Finish();
  Signature signature;
  std::copy_n(digest.begin(), kSignatureBytes, signature.begin());
  return signature;
}

}  // namespace disflow::hal::mavlink

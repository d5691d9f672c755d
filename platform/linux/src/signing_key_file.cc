// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/signing_key_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "disflow/hal/secret.h"
#include "disflow/posix/file_descriptor.h"
#include "errno_fault.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;
using hal::mavlink::SigningKey;

/// 64 hex digits, a line's end, and one byte that tells that the file is longer.
using KeyText = std::array<std::byte, 2 * std::tuple_size_v<SigningKey> + 2 + 1>;

Fault CheckAccess(int fd, const std::string& path) {
  struct stat info {};
  if (::fstat(fd, &info) != 0) {
    return ErrnoFault(Status::kIoError, path.c_str(), "cannot be looked at", errno);
  }
  if (!S_ISREG(info.st_mode)) {
    return MakeFault(Status::kUnsupported, "%s: not an ordinary file; a signing key is needed",
                     path.c_str());
  }
  if ((info.st_mode & (S_IRWXG | S_IRWXO)) == 0) return {};
  return MakeFault(Status::kPermissionDenied,
                   "%s: others than its owner may read or change this key; chmod 600 it",
                   path.c_str());
}

/// @return Number of bytes read, of which there may be one more than a key has; negative: errno is
/// set.
ssize_t ReadAll(int fd, std::span<std::byte> out) noexcept {
  std::size_t size = 0;
  while (size < out.size()) {
    const ssize_t taken =
        RetryOnSignal([&] { return ::read(fd, out.data() + size, out.size() - size); });
    if (taken < 0) return taken;
    if (taken == 0) break;
    size += static_cast<std::size_t>(taken);
  }
  return static_cast<ssize_t>(size);
}

std::optional<unsigned> HexDigit(std::byte byte) noexcept {
  const auto c = static_cast<char>(byte);
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return {};
}

bool ParseHex(std::span<const std::byte> text, SigningKey& key) noexcept {
  if (text.size() != 2 * key.size()) return false;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const std::optional<unsigned> high = HexDigit(text[2 * i]);
    const std::optional<unsigned> low = HexDigit(text[2 * i + 1]);
    if (!high || !low) return false;
    key[i] = static_cast<std::byte>(*high * 16 + *low);
  }
  return true;
}

std::span<const std::byte> WithoutLineEnd(std::span<const std::byte> text) noexcept {
  if (!text.empty() && text.back() == std::byte{'\n'}) text = text.first(text.size() - 1);
  if (!text.empty() && text.back() == std::byte{'\r'}) text = text.first(text.size() - 1);
  return text;
}

Fault ParseKey(std::span<const std::byte> text, const std::string& path, SigningKey& key) {
  if (text.size() == key.size()) {
    std::copy(text.begin(), text.end(), key.begin());
  } else if (!ParseHex(WithoutLineEnd(text), key)) {
    return MakeFault(Status::kCorrupt,
                     "%s: no signing key; a file of 32 bytes or of 64 hex digits is needed",
                     path.c_str());
  }
  if (key != SigningKey{}) return {};
  return MakeFault(Status::kCorrupt, "%s: all bytes of this signing key are zero; make one anew",
                   path.c_str());
}

Fault OpenFault(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return ErrnoFault(Status::kNotFound, path.c_str(), "cannot read the signing key", error);
    case EACCES:
    case EPERM:
      return ErrnoFault(Status::kPermissionDenied, path.c_str(),
                        "cannot read the signing key; it must belong to the user that this runs as",
                        error);
    default:
      return ErrnoFault(Status::kIoError, path.c_str(), "cannot read the signing key", error);
  }
}

}  // namespace

Fault ReadSigningKey(const std::string& path, SigningKey& key) {
  // A pipe that nobody writes to would be waited for.
  const FileDescriptor file(RetryOnSignal(
      [&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK); }));
  if (!file.is_open()) return OpenFault(path, errno);
  Fault fault = CheckAccess(file.get(), path);
  if (!fault.ok()) return fault;
  KeyText text{};
  const ssize_t size = ReadAll(file.get(), text);
  if (size < 0) return OpenFault(path, errno);
  SigningKey parsed{};
  fault = ParseKey(std::span(text).first(static_cast<std::size_t>(size)), path, parsed);
  if (fault.ok()) key = parsed;
  hal::Wipe(text);
  hal::Wipe(parsed);
  return fault;
}

}  // namespace disflow::posix

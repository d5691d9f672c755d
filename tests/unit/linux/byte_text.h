// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace disflow::posix::testing {

[[nodiscard]] inline std::span<const std::byte> BytesOf(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Whatever a link has received by now, at most 4 KiB, as text.
template <class Link>
[[nodiscard]] std::string ReceivedText(Link& link) {
  std::string text(4096, '\0');
  const auto size = link.Receive(std::as_writable_bytes(std::span(text)));
  text.resize(size.ok() ? size.value : 0);
  return text;
}

}  // namespace disflow::posix::testing

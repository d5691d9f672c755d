// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "disflow/hal/mavlink/frame_decoder.h"

namespace disflow::test {

/// A line that carries MAVLink to a part that takes frames.
template <class Input>
class MessageLine {
 public:
  explicit MessageLine(Input& input) : input_(input) {}

  /// Calls input.Take(frame, more...) for every frame that these bytes complete.
  template <class... More>
  void Deliver(std::span<const std::byte> bytes, More... more) {
    decoder_.ForEachFrame(
        bytes, nullptr, [&](const hal::mavlink::FrameView& frame) { input_.Take(frame, more...); });
  }

 private:
  Input& input_;
  hal::mavlink::FrameDecoder decoder_;
};

}  // namespace disflow::test

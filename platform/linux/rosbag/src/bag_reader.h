// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "camera_messages.h"
#include "disflow/hal/fault.h"
#include "topic_names.h"

namespace disflow::posix {

/// No message is longer: sixteen million pixels of four bytes, and what stands around them. Nor is
/// a chunk of messages, so that no file makes a reader take more memory than twice this.
inline constexpr std::size_t kMostMessageBytes = (std::size_t{64} << 20U) + (std::size_t{1} << 20U);

/// The messages of one topic of one file, in the order in which they were recorded.
class BagReader {
 public:
  virtual ~BagReader() = default;
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// @param message Points to memory of this, valid until the next call.
  /// @return kOk, kEndOfStream, kCorrupt (something is lost, the next call goes on).
  [[nodiscard]] virtual hal::Fault Next(BagMessage& message) = 0;
  /// What is not whole although it can be played, for people; empty if all is.
  [[nodiscard]] virtual std::string note() const { return {}; }
  /// Topics that came by until now.
  [[nodiscard]] virtual const TopicNames& names() const noexcept = 0;

 protected:
  BagReader() = default;
};

/// Opens a file by what is in it: MCAP, SQLite as ROS 2 writes it, or a bag of ROS 1.
[[nodiscard]] hal::Fault OpenBagFile(const std::filesystem::path& file, const std::string& topic,
                                     std::unique_ptr<BagReader>& reader);

}  // namespace disflow::posix

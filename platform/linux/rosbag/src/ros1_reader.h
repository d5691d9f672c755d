// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bag_file.h"
#include "bag_reader.h"
#include "byte_cursor.h"
#include "chunk_decompressor.h"
#include "topic_names.h"

namespace disflow::posix {

/// Reads a bag of ROS 1, format 2.0, from its front to its end. Its index is not needed, so that a
/// bag whose recorder was killed (`.bag.active`) reads as far as it goes.
class Ros1Reader final : public BagReader {
 public:
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& file, const std::string& topic);

  [[nodiscard]] hal::Fault Next(BagMessage& message) override;
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] const TopicNames& names() const noexcept override { return names_; }

 private:
  /// A record's header taken apart; what is not in it is zero or empty.
  struct Header {
    std::uint8_t op = 0;
    std::uint32_t connection = 0;
    std::uint32_t size = 0;
    std::uint64_t index_position = 0;
    std::string_view topic;
    std::string_view type;
    std::string_view compression;
  };

  [[nodiscard]] static bool ReadHeader(std::span<std::uint8_t> bytes, Header& header);
  [[nodiscard]] hal::Fault TakeFromFile(BagMessage& message, bool& found);
  [[nodiscard]] hal::Fault TakeFromChunk(BagMessage& message, bool& found);
  [[nodiscard]] hal::Fault TakeRecord(const Header& header, std::span<std::uint8_t> data,
                                      BagMessage& message, bool& found);
  [[nodiscard]] hal::Fault TakeConnection(const Header& header, std::span<std::uint8_t> data);
  [[nodiscard]] hal::Fault OpenChunk(const Header& header, std::span<std::uint8_t> data);

  BagFile file_;
  std::string topic_;
  std::uint64_t at_ = 0;  ///< Where the next record begins.
  bool closed_ = true;    ///< Its recorder came to its end.
  UnpackedTotal total_;
  std::vector<std::uint8_t> header_;
  std::vector<std::uint8_t> data_;
  std::vector<std::uint8_t> chunk_;
  std::span<std::uint8_t> chunk_rest_;  ///< Records that have not been taken.
  std::uint64_t chunk_begin_ = 0;
  std::map<std::uint32_t, std::string> connections_;  ///< Types, of the topic.
  TopicNames names_;
};

}  // namespace disflow::posix

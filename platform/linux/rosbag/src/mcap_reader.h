// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bag_file.h"
#include "bag_reader.h"
#include "byte_cursor.h"
#include "chunk_decompressor.h"
#include "topic_names.h"

namespace disflow::posix {

/// Reads an MCAP file from its front to its end, record by record. Its index is not needed, so that
/// a file whose recorder was killed reads as far as it goes. Checksums are compared where the file
/// has them.
class McapReader final : public BagReader {
 public:
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& file, const std::string& topic);

  [[nodiscard]] hal::Fault Next(BagMessage& message) override;
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] const TopicNames& names() const noexcept override { return names_; }

 private:
  struct Record {
    std::uint8_t opcode = 0;
    std::uint64_t begin = 0;   ///< Of its content, in the file.
    std::uint64_t length = 0;  ///< Of its content.
  };
  struct Channel {
    std::string type;
    Serialization serialization = Serialization::kCdr;
  };

  [[nodiscard]] hal::Fault CheckEnds();
  [[nodiscard]] hal::Fault FindChecksum();
  [[nodiscard]] hal::Fault ReadHead(std::uint64_t begin, Record& record);
  [[nodiscard]] hal::Fault ReadContent(const Record& record, std::uint64_t most);
  [[nodiscard]] hal::Fault AddToChecksum(std::uint64_t end);
  [[nodiscard]] hal::Fault TakeFromFile(BagMessage& message, bool& found);
  [[nodiscard]] hal::Fault TakeFromChunk(BagMessage& message, bool& found);
  [[nodiscard]] hal::Fault TakeRecord(std::uint8_t opcode, std::span<std::uint8_t> content,
                                      BagMessage& message, bool& found);
  [[nodiscard]] hal::Fault TakeSchema(ByteCursor cursor);
  [[nodiscard]] hal::Fault TakeChannel(ByteCursor cursor);
  [[nodiscard]] hal::Fault OpenChunk(const Record& record);
  [[nodiscard]] hal::Fault TakeDataEnd(const Record& record);
  void Stop() noexcept { at_ = file_.size(); }

  BagFile file_;
  std::string topic_;
  std::uint64_t at_ = 0;       ///< Where the next record begins.
  bool closed_ = false;        ///< Its recorder came to its end.
  bool has_checksum_ = false;  ///< Of the data section.
  std::uint64_t checked_ = 0;  ///< Bytes that are in checksum_.
  std::uint32_t checksum_ = 0;
  UnpackedTotal total_;
  std::vector<std::uint8_t> content_;
  std::vector<std::uint8_t> message_;  ///< Unpacked by itself.
  std::vector<std::uint8_t> chunk_;
  std::span<std::uint8_t> chunk_rest_;  ///< Records that have not been taken.
  std::uint64_t chunk_begin_ = 0;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;  ///< Of the topic.
  TopicNames names_;
};

}  // namespace disflow::posix

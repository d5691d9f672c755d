// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bag_reader.h"
#include "chunk_decompressor.h"
#include "topic_names.h"

namespace disflow::posix {

/// Reads a database as rosbag2 writes it (`.db3`), row by row. Its tables are queried, nothing else
/// of the schema is trusted.
class SqliteReader final : public BagReader {
 public:
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& file, const std::string& topic);

  [[nodiscard]] hal::Fault Next(BagMessage& message) override;
  [[nodiscard]] const TopicNames& names() const noexcept override { return names_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept { (void)sqlite3_close_v2(database); }
    void operator()(sqlite3_stmt* statement) const noexcept { (void)sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  void BoundWork();
  [[nodiscard]] hal::Fault Prepare(const char* query, Statement& statement) const;
  [[nodiscard]] hal::Fault CheckTables() const;
  [[nodiscard]] hal::Fault FindTopic(const std::string& topic);
  [[nodiscard]] hal::Fault DatabaseFault(Status status) const;

  std::filesystem::path file_;
  std::uint64_t file_bytes_ = 0;  ///< With its log.
  std::uint64_t most_steps_ = 0;  ///< Of SQLite's machine.
  std::uint64_t steps_ = 0;
  std::unique_ptr<sqlite3, Close> database_;
  Statement messages_;  ///< Of the topic; null if it is not there.
  std::string type_;
  UnpackedTotal total_;
  std::uint64_t read_bytes_ = 0;  ///< Of messages, as they are in the file.
  std::vector<std::uint8_t> row_;
  std::vector<std::uint8_t> message_;  ///< Unpacked.
  TopicNames names_;
};

}  // namespace disflow::posix

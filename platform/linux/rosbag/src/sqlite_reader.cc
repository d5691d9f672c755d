// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite_reader.h"

#include <string_view>
#include <system_error>

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

std::string_view TextAt(sqlite3_stmt* statement, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
  const int size = sqlite3_column_bytes(statement, column);
  return text == nullptr ? std::string_view()
                         : std::string_view(text, static_cast<std::size_t>(size));
}

}  // namespace

Fault SqliteReader::DatabaseFault(Status status) const {
  return MakeFault(status, "%s: SQLite: %s", file_.c_str(), sqlite3_errmsg(database_.get()));
}

Fault SqliteReader::Open(const std::filesystem::path& file, const std::string& topic) {
  file_ = file;
  file_bytes_ = 0;
  steps_ = 0;
  read_bytes_ = 0;
  sqlite3* database = nullptr;
  const int result =
      sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) return DatabaseFault(Status::kIoError);
  // A database of others may hold anything.
  (void)sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostMessageBytes));
  (void)sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  (void)sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  BoundWork();
  Fault fault = CheckTables();
  if (fault.ok()) fault = FindTopic(topic);
  return fault;
}

/// Pages that name the same page again and again make rows without end of a few bytes. A row that
/// is in the file takes ten bytes of it at least and about as many steps.
void SqliteReader::BoundWork() {
  constexpr int kStepsAtATime = 1000;
  constexpr std::uint64_t kFreeSteps = 100'000;
  constexpr std::uint64_t kStepsPerByte = 4;
  // A recorder that was killed may leave rows in a log beside it.
  for (const char* suffix : {"", "-wal"}) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file_.string() + suffix, error);
    if (!error) file_bytes_ += bytes;
  }
  most_steps_ = kFreeSteps + kStepsPerByte * file_bytes_;
  sqlite3_progress_handler(
      database_.get(), kStepsAtATime,
      [](void* of) {
        auto& reader = *static_cast<SqliteReader*>(of);
        reader.steps_ += kStepsAtATime;
        return reader.steps_ > reader.most_steps_ ? 1 : 0;
      },
      this);
}

Fault SqliteReader::Prepare(const char* query, Statement& statement) const {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(database_.get(), query, -1, &prepared, nullptr) != SQLITE_OK)
    return DatabaseFault(Status::kCorrupt);
  statement.reset(prepared);
  return {};
}

/// What only has the tables' names, a view or a virtual table, could compute for ever.
Fault SqliteReader::CheckTables() const {
  Statement statement;
  const Fault fault = Prepare(
      "SELECT count(*) FROM sqlite_master WHERE type='table' AND rootpage > 0 AND name IN "
      "('topics','messages')",
      statement);
  if (!fault.ok()) return fault;
  const int result = sqlite3_step(statement.get());
  if (result != SQLITE_ROW) return DatabaseFault(Status::kCorrupt);
  if (sqlite3_column_int(statement.get(), 0) == 2) return {};
  return MakeFault(Status::kUnsupported,
                   "%s: is a database, but no recording of ROS 2: it has no tables topics and "
                   "messages",
                   file_.c_str());
}

Fault SqliteReader::FindTopic(const std::string& topic) {
  Statement statement;
  Fault fault = Prepare("SELECT id, name, type, serialization_format FROM topics", statement);
  if (!fault.ok()) return fault;
  sqlite3_int64 id = -1;
  int result = SQLITE_ROW;
  while ((result = sqlite3_step(statement.get())) == SQLITE_ROW) {
    const std::string_view name = TextAt(statement.get(), 1);
    const std::string_view type = TextAt(statement.get(), 2).substr(0, 255);
    names_.Add(name, type);
    if (name != topic) continue;
    id = sqlite3_column_int64(statement.get(), 0);
    type_ = type;
    const std::string_view format = TextAt(statement.get(), 3);
    if (format != "cdr") {
      return MakeFault(Status::kUnsupported, "%s: %s is encoded as '%s'; cdr can be read",
                       file_.c_str(), topic.c_str(), ShownText(format, 20).c_str());
    }
  }
  if (result != SQLITE_DONE) return DatabaseFault(Status::kCorrupt);
  if (id < 0) return {};
  // By the rows' own order, which is that of writing: nothing has to be sorted.
  fault = Prepare("SELECT data FROM messages WHERE topic_id = ? ORDER BY rowid", messages_);
  if (fault.ok() && sqlite3_bind_int64(messages_.get(), 1, id) != SQLITE_OK)
    return DatabaseFault(Status::kIoError);
  return fault;
}

Fault SqliteReader::Next(BagMessage& message) {
  const int result = messages_ ? sqlite3_step(messages_.get()) : SQLITE_DONE;
  if (result == SQLITE_ROW) {
    const auto* const data =
        static_cast<const std::uint8_t*>(sqlite3_column_blob(messages_.get(), 0));
    const int size = sqlite3_column_bytes(messages_.get(), 0);
    row_.assign(data, data + (data == nullptr ? 0 : size));
    message.serialization = Serialization::kCdr;
    message.type = type_;
    message.data = row_;
    read_bytes_ += row_.size();
    if (read_bytes_ > file_bytes_) {
      messages_.reset();
      return MakeFault(Status::kCorrupt, "%s: its rows hold more than the file", file_.c_str());
    }
    const Fault fault = DecompressMessage(message_, message.data, total_, read_bytes_);
    if (fault.ok()) return fault;
    return MakeFault(fault.status, "%s: a message of %s: %s", file_.c_str(), type_.c_str(),
                     fault.message);
  }
  // After a fault SQLite would begin anew.
  Fault fault = DatabaseFault(Status::kCorrupt);
  messages_.reset();
  if (result == SQLITE_DONE) fault = MakeFault(Status::kEndOfStream, "%s: is over", file_.c_str());
  return fault;
}

}  // namespace disflow::posix

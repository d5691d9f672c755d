// SPDX-License-Identifier: BSD-3-Clause
#include "topic_stream.h"

#include <algorithm>
#include <system_error>

#include "disflow/host/numbered_files.h"

namespace disflow::posix {

namespace fs = std::filesystem;

using hal::Fault;
using hal::MakeFault;

Fault ListBagFiles(const fs::path& path, std::vector<fs::path>& files) {
  files.clear();
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    files.push_back(path);
    return {};
  }
  for (const char* extension : {".mcap", ".db3"}) {
    // A recording that was split has NAME_0.mcap, NAME_1.mcap, …
    std::vector<host::NumberedFile> numbered;
    const Fault fault = host::ListNumberedFiles(path, extension, numbered);
    if (!fault.ok()) return fault;
    for (const host::NumberedFile& file : numbered) files.push_back(file.path);
    if (!files.empty()) return {};
  }
  return MakeFault(Status::kNotFound, "%s: holds no NAME_0.mcap or NAME_0.db3, as ROS 2 records",
                   path.c_str());
}

Fault NoteWhatIsCut(const std::vector<fs::path>& files, std::string& note) {
  note.clear();
  for (const fs::path& file : files) {
    std::unique_ptr<BagReader> reader;
    const Fault fault = OpenBagFile(file, "", reader);
    if (!fault.ok()) return fault;
    if (!reader->note().empty()) note.append(note.empty() ? "" : "; ").append(reader->note());
  }
  return {};
}

Fault TopicStream::Open(const std::vector<fs::path>& files, const std::string& topic) {
  files_ = files;
  topic_ = topic;
  next_ = 0;
  reader_.reset();
  return OpenNext();
}

Fault TopicStream::OpenNext() { return OpenBagFile(files_[next_++], topic_, reader_); }

Fault TopicStream::Next(BagMessage& message) {
  for (;;) {
    Fault fault = reader_->Next(message);
    if (fault.status != Status::kEndOfStream || next_ == files_.size()) return fault;
    fault = OpenNext();
    if (!fault.ok()) return fault;
  }
}

Fault TopicStream::Missing() const {
  const std::string topics = names().List();
  return MakeFault(Status::kNotFound, "%s: has no message of %s; it has%s", files_.front().c_str(),
                   topic_.c_str(), topics.empty() ? " none at all" : topics.c_str());
}

}  // namespace disflow::posix

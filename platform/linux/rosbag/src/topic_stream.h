// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bag_reader.h"

namespace disflow::posix {

/// The files of a recording: the one that is named, or those of a folder in their order.
/// @return kNotFound if there is none.
[[nodiscard]] hal::Fault ListBagFiles(const std::filesystem::path& path,
                                      std::vector<std::filesystem::path>& files);

/// What is not whole of the files although it can be played, for people; empty if all is.
[[nodiscard]] hal::Fault NoteWhatIsCut(const std::vector<std::filesystem::path>& files,
                                       std::string& note);

/// The messages of one topic through all files of a recording.
class TopicStream {
 public:
  /// From the first message on. May be called again.
  [[nodiscard]] hal::Fault Open(const std::vector<std::filesystem::path>& files,
                                const std::string& topic);
  /// As BagReader::Next(); kEndOfStream behind the last file.
  [[nodiscard]] hal::Fault Next(BagMessage& message);

  [[nodiscard]] const std::string& topic() const noexcept { return topic_; }
  /// Topics that came by in the file that is being read. @pre Open()
  [[nodiscard]] const TopicNames& names() const noexcept { return reader_->names(); }
  /// That the topic is not there, and which are.
  [[nodiscard]] hal::Fault Missing() const;

 private:
  [[nodiscard]] hal::Fault OpenNext();

  std::vector<std::filesystem::path> files_;
  std::string topic_;
  std::size_t next_ = 0;
  std::unique_ptr<BagReader> reader_;
};

}  // namespace disflow::posix

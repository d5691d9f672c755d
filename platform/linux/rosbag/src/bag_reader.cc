// SPDX-License-Identifier: BSD-3-Clause
#include "bag_reader.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "disflow/host/regular_file.h"
#include "mcap_reader.h"
#include "ros1_reader.h"
#include "sqlite_reader.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

template <class Reader>
Fault OpenAs(const std::filesystem::path& file, const std::string& topic,
             std::unique_ptr<BagReader>& reader) {
  auto made = std::make_unique<Reader>();
  const Fault fault = made->Open(file, topic);
  reader = std::move(made);
  return fault;
}

}  // namespace

Fault OpenBagFile(const std::filesystem::path& file, const std::string& topic,
                  std::unique_ptr<BagReader>& reader) {
  if (const Fault fault = host::CheckRegularFile(file); !fault.ok()) return fault;
  std::array<char, 16> start{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return MakeFault(errno == ENOENT ? Status::kNotFound : Status::kIoError, "%s: %s", file.c_str(),
                     std::strerror(errno));
  }
  stream.read(start.data(), start.size());
  const std::string_view text(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (text.starts_with("\x89MCAP")) return OpenAs<McapReader>(file, topic, reader);
  if (text.starts_with("SQLite format 3")) return OpenAs<SqliteReader>(file, topic, reader);
  if (text.starts_with("\x28\xB5\x2F\xFD")) {
    return MakeFault(Status::kUnsupported, "%s: is packed as a whole; unpack it: zstd -d %s",
                     file.c_str(), file.filename().c_str());
  }
  if (text.starts_with("#ROSBAG V2.0\n")) return OpenAs<Ros1Reader>(file, topic, reader);
  if (text.starts_with("#ROSBAG V")) {
    return MakeFault(Status::kUnsupported, "%s: is a bag older than ROS's format 2.0; rosbag fix",
                     file.c_str());
  }
  return MakeFault(Status::kCorrupt,
                   "%s: is neither MCAP nor SQLite, as ROS 2 records them, nor a bag of ROS 1",
                   file.c_str());
}

}  // namespace disflow::posix

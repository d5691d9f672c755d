// SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <vector>

#include "camera_file.h"
#include "disflow/host/png_image.h"
#include "file_in_memory.h"
#include "float_depth_file.h"
#include "text_table.h"

namespace {

using namespace disflow;
using fuzz::Require;

/// A folder in which cam_K.json is the fuzzer's file.
const std::filesystem::path& Folder(const fuzz::FileInMemory& file) {
  static const std::filesystem::path folder = [&file] {
    std::string name = "/tmp/disflow_fuzz_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    if (::symlink(file.path().c_str(), (name + "/cam_K.json").c_str()) != 0) std::abort();
    return std::filesystem::path(name);
  }();
  return folder;
}

void CheckCamera(const fuzz::FileInMemory& file) {
  host::CameraDescription description;
  const hal::Fault fault = host::ReadCamera(Folder(file), description);
  if (fault.ok()) Require(description.width_px > 0 && description.height_px > 0);
}

void CheckDepth(const fuzz::FileInMemory& file) {
  host::FloatImage image;
  if (!host::ReadFloatDepth(file.path(), image).ok()) return;
  Require(image.pixels.size() ==
          static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px));
}

void CheckPng(const fuzz::FileInMemory& file) {
  host::GrayImage image;
  if (!host::ReadGrayPng(file.path(), image).ok()) return;
  Require(image.pixels.size() ==
          static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px));
}

void CheckTable(const fuzz::FileInMemory& file) {
  host::TextTable table;
  if (!table.Read(file.path()).ok()) return;
  std::vector<double> numbers;
  for (const host::TableRow& row : table.rows()) {
    if (table.ParseNumbers(row, 7, numbers).ok()) Require(numbers.size() == 7);
  }
}

}  // namespace

/// The first byte chooses the reader; the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static fuzz::FileInMemory file;
  file.Fill(data + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      CheckCamera(file);
      break;
    case 1:
      CheckDepth(file);
      break;
    case 2:
      CheckPng(file);
      break;
    default:
      CheckTable(file);
      break;
  }
  return 0;
}

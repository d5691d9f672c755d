// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "camera_file.h"
#include "disflow/host/bop_scene.h"
#include "disflow/host/png_image.h"
#include "file_in_memory.h"
#include "float_depth_file.h"
#include "text_table.h"
#include "tum_sequence.h"

namespace {

using namespace disflow;
using fuzz::Require;

/// A folder in which every text is the fuzzer's file.
const std::filesystem::path& Folder(const fuzz::FileInMemory& file) {
  static const fuzz::FolderWithFile folder(
      file, {"cam_K.json", "scene_camera.json", "scene_gt.json", "depth.txt", "groundtruth.txt"});
  return folder.path();
}

void CheckCamera(const fuzz::FileInMemory& file) {
  host::CameraDescription description;
  const hal::Fault fault = host::ReadCamera(Folder(file), description);
  if (fault.ok()) Require(description.width_px > 0 && description.height_px > 0);
}

void CheckBop(const fuzz::FileInMemory& file) {
  host::BopCameras cameras;
  if (host::ReadBopCameras(Folder(file), cameras).ok()) {
    for (const auto& [image, camera] : cameras)
      Require(camera.camera.IsValid() && camera.unit_m > 0.0F);
  }
  host::BopObjects objects;
  if (!host::ReadBopObjects(Folder(file), objects).ok()) return;
  for (const auto& [image, shown] : objects) {
    int place = 0;
    (void)host::FindBopObject(shown, "gt1", place);
    Require(place < static_cast<int>(shown.size()));
  }
}

/// depth.txt lists no image that is there, so that nothing is read but the texts.
void CheckTum(const fuzz::FileInMemory& file) {
  host::ReplayOptions options;
  options.dir = Folder(file);
  host::SequenceIndex index;
  if (host::ListTumSequence(options, index).ok()) Require(!index.frames.empty());
  index.frames.resize(3);
  index.frames[1].stamp_ns = 1'000'000'000;
  (void)host::ReadTumWorldPoses(options.dir, index.frames);
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
  switch (data[0] % 6) {
    case 0:
      CheckCamera(file);
      break;
    case 1:
      CheckDepth(file);
      break;
    case 2:
      CheckPng(file);
      break;
    case 3:
      CheckTable(file);
      break;
    case 4:
      CheckBop(file);
      break;
    default:
      CheckTum(file);
      break;
  }
  return 0;
}

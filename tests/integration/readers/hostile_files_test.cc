// SPDX-License-Identifier: BSD-3-Clause
#include "hostile_files.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "depth_images.h"
#include "disflow/host/obj_file.h"
#include "disflow/host/png_image.h"
#include "disflow/host/replay_sensor.h"
#include "disflow/host/sequence_writer.h"
#include "errors.h"
#include "estimate_csv.h"
#include "ground_truth.h"
#include "limited_process.h"
#include "model_file.h"
#include "ply_file.h"
#include "program/exit_status.h"
#include "scratch_folder.h"
#include "settings/camera_file.h"
#include "settings/settings.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

/// What a reader that throws says; empty if it takes the file.
template <class Read>
std::string Refusal(Read&& read) {
  try {
    read();
  } catch (const apps::InputError& error) {
    return error.what();
  } catch (const apps::Failure& error) {
    return error.what();
  }
  return {};
}

std::string Replay(const fs::path& folder) {
  host::ReplayOptions options;
  options.dir = folder;
  if (fs::exists(folder / "scene_camera.json")) options.rate_hz = 30.0;
  host::ReplaySensor sensor(options);
  hal::Fault fault = sensor.Open();
  DepthFrame frame;
  if (fault.ok()) fault = sensor.Next(0, frame);
  return fault.message;
}

/// @return What the reader says against the file; empty if it takes it.
std::string Read(Reader reader, const fs::path& folder, const fs::path& file) {
  host::GrayImage image;
  host::TriangleMesh mesh;
  Config config;
  switch (reader) {
    case Reader::kPng:
      return host::ReadGrayPng(file, image).message;
    case Reader::kObj:
      return host::ReadObj(file, mesh).message;
    case Reader::kFloatDepth:
    case Reader::kReplay:
      return Replay(folder);
    case Reader::kModel:
      return Refusal([&] { (void)apps::LoadModel(file); });
    case Reader::kPly:
      return Refusal([&] { (void)apps::LoadPly(file); });
    case Reader::kCsv:
      return Refusal([&] { (void)apps::LoadEstimates(file, 1'000'000); });
    case Reader::kTruth:
      return Refusal([&] { (void)apps::LoadGroundTruth(folder, ""); });
    case Reader::kImages:
      return Refusal([&] { (void)apps::DepthImages(folder).Load(0); });
    case Reader::kSettings:
      return Refusal([&] { (void)apps::LoadSettings(file, config); });
    case Reader::kCamera:
      return Refusal([&] { (void)apps::ReadCameraFile(file); });
  }
  return {};
}

class FileReadingTest : public ScratchFolderTest, public testing::WithParamInterface<HostileFile> {
 protected:
  /// A good sequence of two images, of which one file is then replaced.
  void WriteSequence() const {
    const std::vector<float> depth_m(64, 1.0F);
    host::SequenceWriter writer;
    ASSERT_TRUE(writer.Open(folder(), "a", false).ok());
    for (int i = 0; i < 2; ++i) {
      DepthFrame frame;
      frame.depth = {depth_m.data(), 8, 8, 32, DepthFormat::kFloat32};
      frame.camera = {10.0F, 10.0F, 4.0F, 4.0F};
      frame.has_T_wc = true;
      ASSERT_TRUE(writer.AddFrame(frame).ok());
      ASSERT_TRUE(writer.AddTruth({}).ok());
    }
    ASSERT_TRUE(writer.Finish().ok());
  }
  LimitedOutcome WriteAndRead(const HostileFile& hostile) const {
    const fs::path file = this->file();
    WriteFile(file, hostile.contents());
    if (hostile.length >= 0) fs::resize_file(file, static_cast<std::uintmax_t>(hostile.length));
    return RunLimited([&] { return Read(hostile.reader, folder(), file); });
  }
  [[nodiscard]] fs::path folder() const { return scratch() / "sequence"; }
  [[nodiscard]] fs::path file() const { return folder() / GetParam().name; }
};

class HostileFileTest : public FileReadingTest {};
class LargeFileTest : public FileReadingTest {};

TEST_P(HostileFileTest, IsRefusedByNameInLittleMemoryAndTime) {
  ASSERT_NO_FATAL_FAILURE(WriteSequence());
  const LimitedOutcome outcome = WriteAndRead(GetParam());
  EXPECT_EQ(outcome.signal, 0) << "ended by this signal: " << ::strsignal(outcome.signal);
  EXPECT_EQ(outcome.message.substr(0, file().string().size()), file().string()) << "must be named";
  EXPECT_LT(outcome.message.size(), 1000U) << "is for people";
}

TEST_P(LargeFileTest, IsTakenInLittleMemoryAndTime) {
  ASSERT_NO_FATAL_FAILURE(WriteSequence());
  const LimitedOutcome outcome = WriteAndRead(GetParam());
  ASSERT_LE(fs::file_size(file()), 1'100'000U);
  EXPECT_EQ(outcome.signal, 0) << "ended by this signal: " << ::strsignal(outcome.signal);
  EXPECT_EQ(outcome.message, "");
}

INSTANTIATE_TEST_SUITE_P(Readers, LargeFileTest, testing::ValuesIn(LargeFiles()),
                         [](const testing::TestParamInfo<HostileFile>& test) {
                           return std::string(test.param.test);
                         });

INSTANTIATE_TEST_SUITE_P(Readers, HostileFileTest, testing::ValuesIn(HostileFiles()),
                         [](const testing::TestParamInfo<HostileFile>& test) {
                           return std::string(test.param.test);
                         });

}  // namespace
}  // namespace disflow::test

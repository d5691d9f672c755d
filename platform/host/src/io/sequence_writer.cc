// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sequence_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cinttypes>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>

#include "disflow/host/depth_metres.h"
#include "disflow/host/file_output.h"
#include "disflow/host/png_image.h"
#include "disflow/host/sequence_layout.h"
#include "disflow/types.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

hal::Fault MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  const Status status =
      error == std::errc::permission_denied ? Status::kPermissionDenied : Status::kIoError;
  return hal::MakeFault(status, "%s: cannot be created: %s", folder.c_str(),
                        error.message().c_str());
}

/// @param name Empty: of the only object.
fs::path TruthFolder(std::string_view name) {
  return name.empty() ? fs::path(kTruthFolder) : fs::path(kTruthFolder) / name;
}

/// `x y z nx ny nz theta`.
template <class A, class B>
std::string FormatPose(const Transform<A, B, double>& pose) {
  const Vec3d& t = pose.translation();
  const Vec3d theta = LogSo3(pose.rotation());
  const double angle_rad = theta.norm();
  const Vec3d axis = angle_rad > 0.0 ? Vec3d(theta / angle_rad) : Vec3d::UnitZ();
  std::array<char, 256> text{};
  (void)std::snprintf(text.data(), text.size(), "%.12g %.12g %.12g %.15g %.15g %.15g %.15g", t.x(),
                      t.y(), t.z(), axis.x(), axis.y(), axis.z(), angle_rad);
  return text.data();
}

}  // namespace

bool HoldsSequence(const fs::path& dir) {
  std::error_code error;
  if (!fs::is_regular_file(dir / kDataFile, error)) return false;
  if (fs::is_regular_file(dir / kCameraFile, error)) return true;
  // The camera's file comes with the first frame.
  const bool has_no_stamp = fs::file_size(dir / kDataFile, error) == 0;
  return has_no_stamp && fs::is_empty(dir / kDepthFolder, error) && !error;
}

hal::Fault RemoveSequence(const fs::path& dir) {
  if (!HoldsSequence(dir)) {
    return hal::MakeFault(Status::kBusy,
                          "%s: is no sequence (%s and %s) that could be replaced; choose another "
                          "folder",
                          dir.c_str(), kCameraFile, kDataFile);
  }
  // Last what tells a sequence, so that what could not be removed can be removed later.
  for (const char* name : {kDepthFolder, kMaskFolder, kInfraredFolder, kTruthFolder, kWorldPoseFile,
                           kCameraFile, kDataFile}) {
    std::error_code error;
    fs::remove_all(dir / name, error);
    if (error) {
      return hal::MakeFault(Status::kIoError, "%s: cannot be removed: %s", (dir / name).c_str(),
                            error.message().c_str());
    }
  }
  return {};
}

hal::Fault SequenceWriter::Open(const fs::path& dir, std::string_view object, bool overwrite) {
  hal::Fault fault = MakeFolder(dir);
  if (!fault.ok()) return fault;
  std::error_code error;
  if (!fs::is_empty(dir, error) && !error) {
    if (!overwrite) {
      return hal::MakeFault(Status::kBusy, "%s: is not empty; choose another folder or overwrite",
                            dir.c_str());
    }
    fault = RemoveSequence(dir);
    if (!fault.ok()) return fault;
  }
  fault = MakeFolder(dir / kDepthFolder);
  if (!fault.ok()) return fault;
  fault = data_.Open(dir / kDataFile);
  if (!fault.ok()) return fault;
  dir_ = dir;
  object_ = object;
  frames_ = 0;
  image_bytes_ = 0;
  pending_ = false;
  failure_ = {};
  truths_.clear();
  return {};
}

hal::Fault SequenceWriter::GiveUp(const hal::Fault& fault) {
  failure_ = fault;
  if (pending_) --frames_;
  pending_ = false;
  return fault;
}

hal::Fault SequenceWriter::AddFrame(const DepthFrame& frame) {
  if (dir_.empty()) return hal::MakeFault(Status::kNotOpen, "sequence writer: not open");
  const DepthView& depth = frame.depth;
  if (frames_ > 0 && (depth.width_px != width_px_ || depth.height_px != height_px_)) {
    return hal::MakeFault(
        Status::kInvalidImageSize, "%s: frame %d is %dx%d, the sequence is %dx%d; start a new one",
        dir_.c_str(), frames_, depth.width_px, depth.height_px, width_px_, height_px_);
  }
  const hal::Fault fault = CompleteFrame();
  return fault.ok() ? WriteFrame(frame) : fault;
}

hal::Fault SequenceWriter::WriteFrame(const DepthFrame& frame) {
  hal::Fault fault;
  if (frames_ == 0) fault = WriteCamera(frame);
  if (fault.ok()) fault = WriteDepth(frame.depth);
  if (fault.ok()) fault = WriteWorldPose(frame);
  if (!fault.ok()) return GiveUp(fault);
  std::array<char, 64> line{};
  // Not through double, which cannot hold nanoseconds of large stamps.
  (void)std::snprintf(line.data(), line.size(), "%d %" PRId64 ".%09" PRId64, frames_,
                      frame.stamp_ns / kSecond_ns, frame.stamp_ns % kSecond_ns);
  stamp_line_ = line.data();
  pending_ = true;
  ++frames_;
  return {};
}

/// Nothing as long as no frame has one.
hal::Fault SequenceWriter::WriteWorldPose(const DepthFrame& frame) {
  std::string line;
  if (!world_poses_.is_open()) {
    if (!frame.has_T_wc) return {};
    for (int i = 0; i < frames_; ++i) line += std::string(kNoWorldPose) + '\n';
  }
  line += frame.has_T_wc ? FormatPose(frame.T_wc.Cast<double>()) : kNoWorldPose;
  return AppendLine(world_poses_, kWorldPoseFile, line);
}

hal::Fault SequenceWriter::CompleteFrame() {
  if (!failure_.ok() || !pending_) return failure_;
  const hal::Fault fault = data_.Append(stamp_line_);
  if (!fault.ok()) return GiveUp(fault);
  pending_ = false;
  return {};
}

hal::Fault SequenceWriter::CheckPending() const {
  if (!failure_.ok() || pending_) return failure_;
  return hal::MakeFault(Status::kNotOpen, "sequence writer: there is no frame to add this to");
}

hal::Fault SequenceWriter::WriteCamera(const DepthFrame& frame) {
  width_px_ = frame.depth.width_px;
  height_px_ = frame.depth.height_px;
  const auto exact = [](float value) { return static_cast<double>(value); };
  const nlohmann::ordered_json camera{{"width", width_px_},
                                      {"height", height_px_},
                                      {"fx", exact(frame.camera.fx_px)},
                                      {"fy", exact(frame.camera.fy_px)},
                                      {"cx", exact(frame.camera.cx_px)},
                                      {"cy", exact(frame.camera.cy_px)}};
  return WriteWholeFile(dir_ / kCameraFile, camera.dump(2) + '\n');
}

hal::Fault SequenceWriter::WriteDepth(const DepthView& depth) {
  const std::array<std::uint64_t, 2> size{static_cast<std::uint64_t>(width_px_),
                                          static_cast<std::uint64_t>(height_px_)};
  static_assert(std::endian::native == std::endian::little, "the format is little endian");
  const auto columns = static_cast<std::size_t>(width_px_);
  const std::size_t row_bytes = columns * sizeof(float);
  depth_bytes_.resize(sizeof(size) + static_cast<std::size_t>(height_px_) * row_bytes);
  std::memcpy(depth_bytes_.data(), size.data(), sizeof(size));
  CopyMetres(depth, depth_bytes_.data() + sizeof(size));
  image_bytes_ += static_cast<std::int64_t>(depth_bytes_.size());
  return WriteWholeFile(dir_ / kDepthFolder / (std::to_string(frames_) + kDepthExtension),
                        {depth_bytes_.data(), depth_bytes_.size()});
}

hal::Fault SequenceWriter::AddMask(std::string_view set, const MaskView& mask) {
  return WriteMask(object_, set, mask);
}

hal::Fault SequenceWriter::AddMaskOf(std::string_view object, std::string_view set,
                                     const MaskView& mask) {
  const auto width = static_cast<std::size_t>(mask.width_px);
  mask_.resize(width * static_cast<std::size_t>(mask.height_px));
  for (int v = 0; v < mask.height_px; ++v) {
    std::transform(mask.row(v), mask.row(v) + width,
                   mask_.begin() + v * static_cast<std::ptrdiff_t>(width),
                   [&mask](std::uint8_t value) {
                     return static_cast<std::uint8_t>(value == mask.label ? 255 : 0);
                   });
  }
  return WriteMask(object, set, {mask_.data(), mask.width_px, mask.height_px, mask.width_px});
}

hal::Fault SequenceWriter::WriteMask(std::string_view object, std::string_view set,
                                     const MaskView& mask) {
  const std::string name =
      std::string(object) + "_" + std::to_string(frames_ - 1) + kImageExtension;
  return WriteImage(fs::path(kMaskFolder) / set / name, mask);
}

hal::Fault SequenceWriter::AddInfrared(const MaskView& image) {
  return WriteImage(fs::path(kInfraredFolder) / (std::to_string(frames_ - 1) + kImageExtension),
                    image);
}

/// @param file Inside of the sequence's folder.
hal::Fault SequenceWriter::WriteImage(const fs::path& file, const MaskView& image) {
  hal::Fault fault = CheckPending();
  if (!fault.ok()) return fault;
  if (image.width_px != width_px_ || image.height_px != height_px_) {
    return hal::MakeFault(Status::kMaskSizeMismatch, "%s: mask of frame %d is %dx%d, depth %dx%d",
                          dir_.c_str(), frames_ - 1, image.width_px, image.height_px, width_px_,
                          height_px_);
  }
  const fs::path path = dir_ / file;
  fault = MakeFolder(path.parent_path());
  if (fault.ok())
    fault = WriteGray8Png(path, image.data, width_px_, height_px_, image.stride_bytes);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (!error) image_bytes_ += static_cast<std::int64_t>(bytes);
  return fault.ok() ? fault : GiveUp(fault);
}

SequenceWriter::TruthFiles& SequenceWriter::TruthOf(std::string_view name) {
  for (TruthFiles& truth : truths_) {
    if (truth.name == name) return truth;
  }
  TruthFiles& truth = truths_.emplace_back();
  truth.name = name;
  return truth;
}

hal::Fault SequenceWriter::AddTruthOf(std::string_view name,
                                      const RigidState<Camera, Object>& object) {
  hal::Fault fault = CheckPending();
  if (!fault.ok()) return fault;
  TruthFiles& truth = TruthOf(name);
  const fs::path folder = TruthFolder(name);
  fault = MakeFolder(dir_ / folder);
  if (fault.ok()) fault = AppendLine(truth.poses, folder / kPoseFile, FormatPose(object.pose));
  if (!fault.ok()) return GiveUp(fault);
  const Vec3d& v = object.linear_mps;
  const Vec3d& w = object.angular_rps;
  std::array<char, 192> line{};
  (void)std::snprintf(line.data(), line.size(), "%.12g %.12g %.12g %.12g %.12g %.12g", v.x(), v.y(),
                      v.z(), w.x(), w.y(), w.z());
  fault = AppendLine(truth.velocities, folder / kVelocityFile, line.data());
  return fault.ok() ? fault : GiveUp(fault);
}

hal::Fault SequenceWriter::AppendLine(LineFile& file, const fs::path& name, std::string_view line) {
  const hal::Fault fault = file.is_open() ? hal::Fault{} : file.Open(dir_ / name);
  return fault.ok() ? file.Append(line) : fault;
}

hal::Fault SequenceWriter::Finish() {
  hal::Fault fault = CompleteFrame();
  const auto close = [&fault](LineFile& file) {
    const hal::Fault closed = file.Close();
    if (fault.ok()) fault = closed;
  };
  close(data_);
  for (TruthFiles& truth : truths_) {
    close(truth.poses);
    close(truth.velocities);
  }
  close(world_poses_);
  dir_.clear();
  return fault;
}

}  // namespace disflow::host

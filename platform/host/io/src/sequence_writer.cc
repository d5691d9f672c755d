// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sequence_writer.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "disflow/depth/depth_reader.h"
#include "disflow/host/png_file.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;
using hal::Fault;
using hal::MakeFault;

Fault WriteFailed(const std::string& file) {
  return MakeFault(Status::kIoError, "%s: cannot be written: %s", file.c_str(),
                   std::strerror(errno));
}

template <class... Numbers>
std::string Line(const char* format, Numbers... numbers) {
  char text[256];
  (void)std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// `x y z nx ny nz theta`
template <class A, class B>
std::string PoseLine(const Transform<A, B, double>& pose) {
  const Vec3d turn = LogSo3(pose.rotation());
  const double angle_rad = turn.norm();
  const Vec3d axis = angle_rad > 1e-15 ? Vec3d(turn / angle_rad) : Vec3d(Vec3d::UnitX());
  const Vec3d& t = pose.translation();
  return Line("%.12g %.12g %.12g %.15g %.15g %.15g %.15g\n", t.x(), t.y(), t.z(), axis.x(),
              axis.y(), axis.z(), angle_rad);
}

}  // namespace

Fault SequenceWriter::Open(const std::string& directory, const std::string& object_name,
                           bool overwrite) {
  directory_ = directory;
  object_name_ = object_name;
  frames_ = 0;
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error)) {
    return MakeFault(Status::kIoError, "%s: is not a folder", directory.c_str());
  }
  if (fs::is_directory(directory, error) && !fs::is_empty(directory, error)) {
    if (!overwrite) {
      return MakeFault(Status::kIoError,
                       "%s: holds files already; choose another folder or allow overwriting",
                       directory.c_str());
    }
    // Left-over frames of a longer sequence would be taken for this one's.
    for (const char* part : {"depth", "masks", "gt", "data.txt", "T_wc.txt", "cam_K.json"}) {
      fs::remove_all(fs::path(directory) / part, error);
    }
  }
  fs::create_directories(fs::path(directory) / "depth", error);
  if (error)
    return MakeFault(Status::kIoError, "%s: %s", directory.c_str(), error.message().c_str());
  return {};
}

Fault SequenceWriter::Write(const DepthFrame& frame) {
  if (frames_ == 0) {
    if (const Fault fault = WriteCamera(frame); !fault.ok()) return fault;
  }
  if (const Fault fault = WriteDepth(frame.depth); !fault.ok()) return fault;
  const double stamp_s = static_cast<double>(frame.stamp_ns) * 1e-9;
  if (const Fault fault = Append(data_, "data.txt", Line("%d %.9f\n", frames_, stamp_s));
      !fault.ok())
    return fault;
  if (frame.has_T_wc) {
    const Fault fault = Append(camera_poses_, "T_wc.txt", PoseLine(frame.T_wc.Cast<double>()));
    if (!fault.ok()) return fault;
  }
  ++frames_;
  return frame.mask.given() ? WriteMask("gt", frame.mask) : Fault{};
}

Fault SequenceWriter::WriteCamera(const DepthFrame& frame) {
  const std::string file = directory_ + "/cam_K.json";
  std::ofstream stream(file);
  stream << nlohmann::json{{"width", frame.depth.width_px}, {"height", frame.depth.height_px},
                           {"fx", frame.camera.fx_px},      {"fy", frame.camera.fy_px},
                           {"cx", frame.camera.cx_px},      {"cy", frame.camera.cy_px}}
                .dump(2)
         << '\n';
  stream.close();
  return stream ? Fault{} : WriteFailed(file);
}

Fault SequenceWriter::WriteDepth(const DepthView& depth) {
  constexpr float kAnyRange_m = 1e6F;
  const DepthReader reader(depth, 0.0F, kAnyRange_m);
  depth_m_.resize(static_cast<std::size_t>(depth.width_px) *
                  static_cast<std::size_t>(depth.height_px));
  std::size_t i = 0;
  for (int v = 0; v < depth.height_px; ++v) {
    for (int u = 0; u < depth.width_px; ++u) depth_m_[i++] = reader.At(u, v);
  }
  const std::string file = directory_ + "/depth/" + std::to_string(frames_) + ".float";
  File handle(std::fopen(file.c_str(), "wb"));
  if (!handle) return WriteFailed(file);
  const std::uint64_t size[2] = {static_cast<std::uint64_t>(depth.width_px),
                                 static_cast<std::uint64_t>(depth.height_px)};
  const bool written =
      std::fwrite(size, sizeof size, 1, handle.get()) == 1 &&
      std::fwrite(depth_m_.data(), sizeof(float), depth_m_.size(), handle.get()) == depth_m_.size();
  // fclose() flushes: a full disk shows here.
  return std::fclose(handle.release()) == 0 && written ? Fault{} : WriteFailed(file);
}

Fault SequenceWriter::WriteMask(const std::string& set, const MaskView& mask) {
  const fs::path folder = fs::path(directory_) / "masks" / set;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return MakeFault(Status::kIoError, "%s: %s", folder.c_str(), error.message().c_str());
  const auto width = static_cast<std::size_t>(mask.width_px);
  mask_.resize(width * static_cast<std::size_t>(mask.height_px));
  for (int v = 0; v < mask.height_px; ++v)
    std::memcpy(&mask_[static_cast<std::size_t>(v) * width], mask.row(v), width);
  const std::string file =
      (folder / (object_name_ + "_" + std::to_string(frames_ - 1) + ".png")).string();
  return WritePng(file, mask.width_px, mask.height_px, 1, mask_);
}

Fault SequenceWriter::WriteTruth(const FrameTruth& truth) {
  std::error_code error;
  fs::create_directories(fs::path(directory_) / "gt", error);
  if (error)
    return MakeFault(Status::kIoError, "%s/gt: %s", directory_.c_str(), error.message().c_str());
  if (const Fault fault = Append(poses_, "gt/poses.txt", PoseLine(truth.object.pose)); !fault.ok())
    return fault;
  const Vec3d& v = truth.object.linear_mps;
  const Vec3d& w = truth.object.angular_rps;
  return Append(
      velocities_, "gt/velocities.txt",
      Line("%.12g %.12g %.12g %.12g %.12g %.12g\n", v.x(), v.y(), v.z(), w.x(), w.y(), w.z()));
}

Fault SequenceWriter::Append(File& file, const char* name, const std::string& line) {
  const std::string path = directory_ + "/" + name;
  if (!file) file.reset(std::fopen(path.c_str(), "wb"));
  if (!file || std::fwrite(line.data(), 1, line.size(), file.get()) != line.size())
    return WriteFailed(path);
  return {};
}

Fault SequenceWriter::Finish(File& file, const char* name) {
  if (file && std::fclose(file.release()) != 0) return WriteFailed(directory_ + "/" + name);
  return {};
}

Fault SequenceWriter::Close() {
  Fault first;
  const auto keep = [&first](const Fault& fault) {
    if (first.ok()) first = fault;
  };
  keep(Finish(data_, "data.txt"));
  keep(Finish(poses_, "gt/poses.txt"));
  keep(Finish(velocities_, "gt/velocities.txt"));
  keep(Finish(camera_poses_, "T_wc.txt"));
  return first;
}

}  // namespace disflow::host

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libcamera/camera.h>
#include <libcamera/camera_manager.h>
#include <libcamera/framebuffer_allocator.h>
#include <libcamera/request.h>

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "disflow/hal/fault.h"
#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/camera_description.h"

namespace disflow::posix {

/// One camera of libcamera from its acquisition to its release: the part that talks to libcamera's
/// own thread.
class LibcameraSession {
 public:
  static constexpr unsigned kBuffers = 6;

  LibcameraSession() = default;
  LibcameraSession(const LibcameraSession&) = delete;
  LibcameraSession& operator=(const LibcameraSession&) = delete;
  ~LibcameraSession() { Close(); }

  [[nodiscard]] hal::Fault Open(const CameraAddress& address, const CameraDescription& description);
  void Close();
  /// Lets go of a camera without stopping it: what it holds stays with libcamera until the program
  /// ends.
  void Abandon();

  /// Waits for a completed request. @return Null if none came in time or the camera is gone.
  [[nodiscard]] libcamera::Request* Take(std::int64_t timeout_ns);
  /// Gives a request back to the camera. @return false if the camera does not take it.
  [[nodiscard]] bool Return(libcamera::Request* request);
  [[nodiscard]] bool disconnected();

  [[nodiscard]] const std::string& id() const { return id_; }
  [[nodiscard]] const DepthPixelFormat& format() const { return *format_; }
  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] std::size_t stride_bytes() const { return stride_bytes_; }

  /// The image of a completed request.
  [[nodiscard]] const std::byte* Image(const libcamera::Request& request) const;
  [[nodiscard]] const libcamera::FrameMetadata& Metadata(const libcamera::Request& request) const;

 private:
  struct Mapping {
    void* memory = nullptr;
    std::size_t length = 0;
    std::size_t offset = 0;
  };

  [[nodiscard]] hal::Fault FindCamera(const CameraAddress& address);
  [[nodiscard]] hal::Fault Configure(const CameraAddress& address,
                                     const CameraDescription& description);
  [[nodiscard]] hal::Fault MakeRequests();
  [[nodiscard]] hal::Fault Start();
  [[nodiscard]] bool MapBuffer(const libcamera::FrameBuffer& buffer);
  void OnCompleted(libcamera::Request* request);
  void OnDisconnected();

  // The manager goes last: everything else is its.
  std::unique_ptr<libcamera::CameraManager> manager_;
  std::shared_ptr<libcamera::Camera> camera_;
  std::unique_ptr<libcamera::CameraConfiguration> configuration_;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;
  std::vector<Mapping> mappings_;  ///< By the requests' cookies.
  libcamera::Stream* stream_ = nullptr;
  bool acquired_ = false;
  bool started_ = false;
  std::string id_;
  const DepthPixelFormat* format_ = nullptr;
  int width_px_ = 0;
  int height_px_ = 0;
  std::size_t stride_bytes_ = 0;
  std::int64_t frame_duration_us_ = 0;  ///< 0 = the camera's own.

  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<libcamera::Request*, 4 * kBuffers> completed_{};  ///< Oldest first. Guarded.
  std::size_t completed_count_ = 0;                            ///< Guarded.
  bool disconnected_ = false;                                  ///< Guarded.
};

}  // namespace disflow::posix

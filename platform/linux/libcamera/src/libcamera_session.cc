// SPDX-License-Identifier: BSD-3-Clause
#include "libcamera_session.h"

#include <libcamera/control_ids.h>
#include <libcamera/logging.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "raw_format.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

Fault Refused(const char* device, const char* what, int result) {
  const Status status = result == -EBUSY    ? Status::kBusy
                        : result == -ENODEV ? Status::kDeviceLost
                        : result == -EACCES ? Status::kPermissionDenied
                                            : Status::kIoError;
  return MakeFault(status, "libcamera:%s: %s: %s", device, what, std::strerror(-result));
}

std::string ListFormats(const libcamera::StreamFormats& formats) {
  std::string list;
  for (const libcamera::PixelFormat& raw : formats.pixelformats()) {
    const DepthPixelFormat* const depth = DepthFormatOf(raw);
    list += (list.empty() ? "" : ", ") + (depth != nullptr ? depth->name : raw.toString());
    for (const libcamera::Size& size : formats.sizes(raw)) list += " " + size.toString();
  }
  return list.empty() ? "nothing" : list;
}

const DepthPixelFormat* ChooseFormat(const CameraAddress& address,
                                     const libcamera::StreamFormats& formats) {
  const auto offered = formats.pixelformats();
  for (const DepthPixelFormat& format : LibcameraDepthFormats()) {
    if (address.format != nullptr && address.format != &format) continue;
    if (std::find(offered.begin(), offered.end(), RawFormat(format)) != offered.end()) {
      return &format;
    }
  }
  return nullptr;
}

}  // namespace

Fault LibcameraSession::Open(const CameraAddress& address, const CameraDescription& description) {
  libcamera::logSetTarget(libcamera::LoggingTargetNone);
  manager_ = std::make_unique<libcamera::CameraManager>();
  Fault fault;
  if (const int result = manager_->start(); result != 0) {
    fault = Refused(address.device, "libcamera cannot be started", result);
  }
  if (fault.ok()) fault = FindCamera(address);
  if (fault.ok()) fault = Configure(address, description);
  if (fault.ok()) fault = MakeRequests();
  if (fault.ok()) fault = Start();
  if (!fault.ok()) Close();
  return fault;
}

Fault LibcameraSession::FindCamera(const CameraAddress& address) {
  const auto cameras = manager_->cameras();
  std::size_t number = cameras.size();
  const char* const end = address.device + std::strlen(address.device);
  const bool is_number = std::from_chars(address.device, end, number).ptr == end;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string& candidate = cameras[i]->id();
    if (is_number ? i == number : candidate == address.device) camera_ = cameras[i];
  }
  if (!camera_) {
    return MakeFault(Status::kNotFound,
                     "libcamera:%s: no such camera among %zu; is it plugged in? See --list-sensors",
                     address.device, cameras.size());
  }
  id_ = camera_->id();
  if (const int result = camera_->acquire(); result != 0) {
    return Refused(address.device, "in use by another program", result);
  }
  acquired_ = true;
  camera_->requestCompleted.connect(this, &LibcameraSession::OnCompleted);
  camera_->disconnected.connect(this, &LibcameraSession::OnDisconnected);
  return {};
}

Fault LibcameraSession::Configure(const CameraAddress& address,
                                  const CameraDescription& description) {
  configuration_ = camera_->generateConfiguration({libcamera::StreamRole::Raw});
  if (!configuration_ || configuration_->empty()) {
    configuration_ = camera_->generateConfiguration({libcamera::StreamRole::Viewfinder});
  }
  if (!configuration_ || configuration_->empty()) {
    return MakeFault(Status::kUnsupported, "libcamera:%s: offers no stream", address.device);
  }
  libcamera::StreamConfiguration& stream = configuration_->at(0);
  const std::string offered = ListFormats(stream.formats());
  format_ = ChooseFormat(address, stream.formats());
  if (format_ == nullptr) {
    return MakeFault(Status::kUnsupported, "libcamera:%s: offers no %s; it has: %s", address.device,
                     address.format != nullptr ? address.format->name : "16-bit raw format",
                     offered.c_str());
  }
  stream.pixelFormat = RawFormat(*format_);
  if (description.width_px > 0) {
    stream.size = {static_cast<unsigned>(description.width_px),
                   static_cast<unsigned>(description.height_px)};
  }
  stream.bufferCount = kBuffers;
  const libcamera::Size wanted = stream.size;
  const auto verdict = configuration_->validate();
  if (verdict == libcamera::CameraConfiguration::Invalid || stream.size != wanted ||
      stream.pixelFormat != RawFormat(*format_)) {
    return MakeFault(Status::kUnsupported,
                     "libcamera:%s: %s at %s is not delivered, the nearest is %s; it has: %s",
                     address.device, format_->name, wanted.toString().c_str(),
                     stream.toString().c_str(), offered.c_str());
  }
  if (const int result = camera_->configure(configuration_.get()); result != 0) {
    return Refused(address.device, "cannot be configured", result);
  }
  if (address.rate_hz > 0.0F &&
      camera_->controls().count(libcamera::controls::FrameDurationLimits.id()) == 0) {
    return MakeFault(Status::kUnsupported,
                     "libcamera:%s: has no frame rate to set; leave fps= away", address.device);
  }
  stream_ = stream.stream();
  width_px_ = static_cast<int>(stream.size.width);
  height_px_ = static_cast<int>(stream.size.height);
  const std::size_t row_bytes = MinRowBytes(*format_, width_px_);
  stride_bytes_ = std::max<std::size_t>(stream.stride, row_bytes);
  if (address.rate_hz > 0.0F) {
    constexpr float kUsPerSecond = 1e6F;
    frame_duration_us_ = std::lround(kUsPerSecond / address.rate_hz);
  }
  return {};
}

Fault LibcameraSession::MakeRequests() {
  allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
  if (const int result = allocator_->allocate(stream_); result < 0) {
    return Refused(id_.c_str(), "cannot get buffers", result);
  }
  for (const auto& buffer : allocator_->buffers(stream_)) {
    auto request = camera_->createRequest(mappings_.size());
    if (!request || request->addBuffer(stream_, buffer.get()) != 0 || !MapBuffer(*buffer)) {
      return Refused(id_.c_str(), "cannot use a buffer", -ENOMEM);
    }
    requests_.push_back(std::move(request));
  }
  return {};
}

bool LibcameraSession::MapBuffer(const libcamera::FrameBuffer& buffer) {
  const auto& plane = buffer.planes().at(0);
  const std::size_t needed =
      stride_bytes_ * static_cast<std::size_t>(height_px_ - 1) + MinRowBytes(*format_, width_px_);
  if (plane.length < needed) return false;
  const std::size_t offset =
      plane.offset == libcamera::FrameBuffer::Plane::kInvalidOffset ? 0 : plane.offset;
  const std::size_t length = offset + plane.length;
  void* const memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, plane.fd.get(), 0);
  if (memory == MAP_FAILED) return false;
  mappings_.push_back({memory, length, offset});
  return true;
}

Fault LibcameraSession::Start() {
  libcamera::ControlList controls;
  if (frame_duration_us_ > 0) {
    const std::array<std::int64_t, 2> limits{frame_duration_us_, frame_duration_us_};
    controls.set(libcamera::controls::FrameDurationLimits,
                 libcamera::Span<const std::int64_t, 2>(limits));
  }
  if (const int result = camera_->start(&controls); result != 0) {
    return Refused(id_.c_str(), "cannot start", result);
  }
  started_ = true;
  for (const auto& request : requests_) {
    if (const int result = camera_->queueRequest(request.get()); result != 0) {
      return Refused(id_.c_str(), "cannot queue a request", result);
    }
  }
  return {};
}

void LibcameraSession::Abandon() {
  if (camera_) {
    camera_->requestCompleted.disconnect(this);
    camera_->disconnected.disconnect(this);
    new std::shared_ptr<libcamera::Camera>(std::move(camera_));
  }
  for (auto& request : requests_) (void)request.release();
  requests_.clear();
  mappings_.clear();
  (void)allocator_.release();
  (void)configuration_.release();
  (void)manager_.release();
  started_ = acquired_ = false;
}

void LibcameraSession::Close() {
  if (disconnected()) Abandon();
  if (started_) (void)camera_->stop();
  started_ = false;
  if (camera_) {
    camera_->requestCompleted.disconnect(this);
    camera_->disconnected.disconnect(this);
  }
  requests_.clear();
  for (const Mapping& mapping : mappings_) (void)::munmap(mapping.memory, mapping.length);
  mappings_.clear();
  allocator_.reset();
  configuration_.reset();
  if (acquired_) (void)camera_->release();
  acquired_ = false;
  camera_.reset();
  if (manager_) manager_->stop();
  manager_.reset();
  const std::lock_guard lock(mutex_);
  completed_count_ = 0;
  disconnected_ = false;
}

void LibcameraSession::OnCompleted(libcamera::Request* request) {
  const std::lock_guard lock(mutex_);
  // There are never more under way than there are requests.
  if (completed_count_ < completed_.size()) completed_[completed_count_++] = request;
  changed_.notify_one();
}

void LibcameraSession::OnDisconnected() {
  const std::lock_guard lock(mutex_);
  disconnected_ = true;
  changed_.notify_one();
}

bool LibcameraSession::disconnected() {
  const std::lock_guard lock(mutex_);
  return disconnected_;
}

libcamera::Request* LibcameraSession::Take(std::int64_t timeout_ns) {
  std::unique_lock lock(mutex_);
  (void)changed_.wait_for(lock, std::chrono::nanoseconds(timeout_ns),
                          [this] { return completed_count_ > 0 || disconnected_; });
  if (completed_count_ == 0) return nullptr;
  libcamera::Request* const request = completed_[0];
  std::move(completed_.begin() + 1,
            completed_.begin() + static_cast<std::ptrdiff_t>(completed_count_), completed_.begin());
  --completed_count_;
  return request;
}

bool LibcameraSession::Return(libcamera::Request* request) {
  request->reuse(libcamera::Request::ReuseBuffers);
  return camera_->queueRequest(request) == 0;
}

const std::byte* LibcameraSession::Image(const libcamera::Request& request) const {
  const Mapping& mapping = mappings_[static_cast<std::size_t>(request.cookie())];
  return static_cast<const std::byte*>(mapping.memory) + mapping.offset;
}

const libcamera::FrameMetadata& LibcameraSession::Metadata(
    const libcamera::Request& request) const {
  return request.findBuffer(stream_)->metadata();
}

}  // namespace disflow::posix

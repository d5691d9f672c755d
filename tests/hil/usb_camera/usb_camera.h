// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <fstream>
#include <string>

#include "fault_plan.h"
#include "usbip_protocol.h"
#include "uvc_descriptors.h"

namespace disflow::hil {

/// The device end of one vhci port: a UVC camera that plays a file of raw images, one after the
/// other, as soon as somebody takes the stream.
class UsbCamera {
 public:
  UsbCamera(const CameraModelOptions& options, FaultPlan faults, std::ifstream frames,
            int frame_count);
  UsbCamera(const UsbCamera&) = delete;
  UsbCamera& operator=(const UsbCamera&) = delete;
  ~UsbCamera() { Detach(); }

  /// Plugs in. @throws std::runtime_error
  void Attach();
  void Detach();

  /// Serves the host until the next moment at which something is due.
  /// @throws std::runtime_error if the host misbehaves.
  void Step();

  /// Frames sent so far.
  [[nodiscard]] int played() const { return next_frame_; }
  [[nodiscard]] bool finished() const { return next_frame_ >= frame_count_ && !sending_; }

 private:
  struct Transfer {
    std::uint32_t sequence;
    std::uint32_t length;
  };

  void Serve();
  void Submit(const UsbipHeader& header);
  void Unlink(const UsbipHeader& header);
  void Control(const UsbipHeader& header);
  [[nodiscard]] bool Answer(const SetupPacket& setup, Bytes& answer);
  void Reply(std::uint32_t sequence, std::int32_t status, const std::uint8_t* data,
             std::uint32_t length, bool to_host);
  void StartFrame(std::int64_t now_ns);
  void SendWhatFits();

  CameraModelOptions options_;
  FaultPlan faults_;
  std::ifstream file_;
  int frame_count_;
  int socket_ = -1;
  std::uint8_t configuration_ = 0;
  std::deque<Transfer> transfers_;
  bool streaming_ = false;
  bool sending_ = false;
  Bytes payload_;
  std::size_t sent_ = 0;
  int next_frame_ = 0;
  bool toggle_ = false;
  std::int64_t due_ns_ = 0;
};

}  // namespace disflow::hil

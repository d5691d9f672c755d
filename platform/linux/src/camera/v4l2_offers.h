// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <span>

#include "disflow/posix/camera/video_kernel.h"

/// @file
/// What a V4L2 device says it could deliver. Lists for people are cut to the text's size; every
/// enumeration is bounded, whatever a driver answers.

namespace disflow::posix {

struct StreamLayout;

/// @return false after the last one.
[[nodiscard]] bool NextFormat(VideoKernel& kernel, int fd, std::uint32_t index,
                              v4l2_fmtdesc& entry) noexcept;
[[nodiscard]] bool NextSize(VideoKernel& kernel, int fd, std::uint32_t index, std::uint32_t fourcc,
                            v4l2_frmsizeenum& entry) noexcept;
[[nodiscard]] bool NextRate(VideoKernel& kernel, int fd, std::uint32_t index, std::uint32_t fourcc,
                            std::uint32_t width, std::uint32_t height,
                            v4l2_frmivalenum& entry) noexcept;

/// "Z16, YUYV".
void ListFormats(VideoKernel& kernel, int fd, std::span<char> text) noexcept;
/// "640x480, 320x240" or "16x16 to 1920x1080".
void ListSizes(VideoKernel& kernel, int fd, std::uint32_t fourcc, std::span<char> text) noexcept;
/// "30, 15".
void ListRates(VideoKernel& kernel, int fd, const StreamLayout& layout,
               std::span<char> text) noexcept;
void ListRates(VideoKernel& kernel, int fd, std::uint32_t fourcc, std::uint32_t width,
               std::uint32_t height, std::span<char> text) noexcept;

}  // namespace disflow::posix

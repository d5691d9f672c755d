// SPDX-License-Identifier: BSD-3-Clause
#include "v4l2_offers.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "v4l2_format.h"

namespace disflow::posix {
namespace {

constexpr std::uint32_t kMaxEntries = 64;

/// Builds "a, b, c" in fixed memory; what does not fit is shown as "...".
class TextList {
 public:
  explicit TextList(std::span<char> text) noexcept : text_(text) { text_[0] = '\0'; }
  ~TextList() {
    if (used_ == 0) (void)std::snprintf(text_.data(), text_.size(), "none");
  }
  TextList(const TextList&) = delete;
  TextList& operator=(const TextList&) = delete;

  [[gnu::format(printf, 2, 3)]] void Add(const char* format, ...) noexcept {
    char item[48];
    va_list arguments;
    va_start(arguments, format);
    (void)std::vsnprintf(item, sizeof(item), format, arguments);
    va_end(arguments);
    const std::size_t length = std::strlen(item) + 2;
    if (full_) return;
    full_ = used_ + length + sizeof(", ...") > text_.size();
    const int written = std::snprintf(text_.data() + used_, text_.size() - used_, "%s%s",
                                      used_ == 0 ? "" : ", ", full_ ? "..." : item);
    used_ += static_cast<std::size_t>(written);
  }

 private:
  std::span<char> text_;
  std::size_t used_ = 0;
  bool full_ = false;
};

double ImagesPerSecond(const v4l2_fract& interval) noexcept {
  return static_cast<double>(interval.denominator) /
         static_cast<double>(interval.numerator == 0 ? 1 : interval.numerator);
}

}  // namespace

bool NextFormat(VideoKernel& kernel, int fd, std::uint32_t index, v4l2_fmtdesc& entry) noexcept {
  entry = {};
  entry.index = index;
  entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  return index < kMaxEntries && kernel.Ioctl(fd, VIDIOC_ENUM_FMT, &entry) == 0;
}

bool NextSize(VideoKernel& kernel, int fd, std::uint32_t index, std::uint32_t fourcc,
              v4l2_frmsizeenum& entry) noexcept {
  entry = {};
  entry.index = index;
  entry.pixel_format = fourcc;
  return index < kMaxEntries && kernel.Ioctl(fd, VIDIOC_ENUM_FRAMESIZES, &entry) == 0;
}

bool NextRate(VideoKernel& kernel, int fd, std::uint32_t index, std::uint32_t fourcc,
              std::uint32_t width, std::uint32_t height, v4l2_frmivalenum& entry) noexcept {
  entry = {};
  entry.index = index;
  entry.pixel_format = fourcc;
  entry.width = width;
  entry.height = height;
  return index < kMaxEntries && kernel.Ioctl(fd, VIDIOC_ENUM_FRAMEINTERVALS, &entry) == 0;
}

void ListFormats(VideoKernel& kernel, int fd, std::span<char> text) noexcept {
  TextList list(text);
  v4l2_fmtdesc entry;
  for (std::uint32_t i = 0; NextFormat(kernel, fd, i, entry); ++i) {
    const DepthPixelFormat* const known = FindFormat(V4l2DepthFormats(), entry.pixelformat);
    list.Add("%s", known != nullptr ? known->name : FourccText(entry.pixelformat).text.data());
  }
}

void ListSizes(VideoKernel& kernel, int fd, std::uint32_t fourcc, std::span<char> text) noexcept {
  TextList list(text);
  v4l2_frmsizeenum entry;
  for (std::uint32_t i = 0; NextSize(kernel, fd, i, fourcc, entry); ++i) {
    if (entry.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      list.Add("%ux%u", entry.discrete.width, entry.discrete.height);
      continue;
    }
    const v4l2_frmsize_stepwise& range = entry.stepwise;
    list.Add("%ux%u to %ux%u", range.min_width, range.min_height, range.max_width,
             range.max_height);
    return;
  }
}

void ListRates(VideoKernel& kernel, int fd, std::uint32_t fourcc, std::uint32_t width,
               std::uint32_t height, std::span<char> text) noexcept {
  TextList list(text);
  v4l2_frmivalenum entry;
  for (std::uint32_t i = 0; NextRate(kernel, fd, i, fourcc, width, height, entry); ++i) {
    if (entry.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      list.Add("%.4g", ImagesPerSecond(entry.discrete));
      continue;
    }
    list.Add("%.4g to %.4g", ImagesPerSecond(entry.stepwise.max),
             ImagesPerSecond(entry.stepwise.min));
    return;
  }
}

void ListRates(VideoKernel& kernel, int fd, const StreamLayout& layout,
               std::span<char> text) noexcept {
  ListRates(kernel, fd, layout.format->fourcc, static_cast<std::uint32_t>(layout.width_px),
            static_cast<std::uint32_t>(layout.height_px), text);
}

}  // namespace disflow::posix

// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/camera_address.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <system_error>

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

constexpr std::string_view kV4l2Scheme = "v4l2:";
constexpr std::string_view kLibcameraScheme = "libcamera:";
constexpr std::string_view kSerialKey = "serial=";

/// For "%.*s"; longer texts would not fit into a Fault.
struct Shown {
  explicit Shown(std::string_view view) noexcept
      : size(static_cast<int>(std::min<std::size_t>(view.size(), 64))), text(view.data()) {}
  int size;
  const char* text;
};

/// Cuts off and returns what is ahead of the first `separator`, which goes too.
std::string_view TakeUntil(char separator, std::string_view& rest) noexcept {
  const std::size_t found = std::min(rest.find(separator), rest.size());
  const std::string_view head(rest.data(), found);
  rest.remove_prefix(std::min(found + 1, rest.size()));
  return head;
}

template <std::size_t kSize>
Fault CopyText(const char* what, std::string_view text, char (&out)[kSize]) noexcept {
  // An embedded zero would silently cut the name for the operating system.
  if (text.empty() || text.size() >= kSize || text.find('\0') != std::string_view::npos) {
    return MakeFault(Status::kInvalidUri, "%s '%.*s' is empty or longer than %zu characters", what,
                     Shown(text).size, Shown(text).text, kSize - 1);
  }
  std::memcpy(out, text.data(), text.size());
  out[text.size()] = '\0';
  return {};
}

template <class Number>
bool ReadNumber(std::string_view text, Number min, Number max, Number& value) noexcept {
  Number parsed{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, parsed);
  // Written so that NaN fails.
  if (error != std::errc{} || stop != end || !(parsed >= min && parsed <= max)) return false;
  value = parsed;
  return true;
}

template <class Number>
Fault ParseNumber(const char* key, std::string_view text, Number min, Number max,
                  Number& value) noexcept {
  if (ReadNumber(text, min, max, value)) return {};
  return MakeFault(Status::kInvalidUri, "%s=%.*s is not a number from %g to %g", key,
                   Shown(text).size, Shown(text).text, static_cast<double>(min),
                   static_cast<double>(max));
}

Fault ParseCamera(std::string_view text, PinholeCamera& camera) noexcept {
  constexpr float kMax_px = 1e5F;
  std::array<float, 4> values{};
  std::string_view rest = text;
  bool ok = std::count(text.begin(), text.end(), ',') == 3;
  for (std::size_t i = 0; i < values.size() && ok; ++i) {
    ok = ReadNumber(TakeUntil(',', rest), i < 2 ? 1.0F : -kMax_px, kMax_px, values[i]);
  }
  if (!ok) {
    return MakeFault(Status::kInvalidUri,
                     "K=%.*s is not fx,fy,cx,cy: four numbers in pixels, focal lengths from 1",
                     Shown(text).size, Shown(text).text);
  }
  camera = {values[0], values[1], values[2], values[3]};
  return {};
}

Fault ParseFormat(std::string_view text, CameraAddress& address) noexcept {
  const bool is_v4l2 = address.kind == CameraAddress::Kind::kV4l2;
  const auto formats = is_v4l2 ? V4l2DepthFormats() : LibcameraDepthFormats();
  address.format = FindFormat(formats, text);
  if (address.format != nullptr) return {};
  char known[64] = {};
  for (const DepthPixelFormat& format : formats) {
    std::strncat(known, known[0] == '\0' ? "" : ", ", sizeof(known) - std::strlen(known) - 1);
    std::strncat(known, format.name, sizeof(known) - std::strlen(known) - 1);
  }
  return MakeFault(Status::kInvalidUri, "format=%.*s is no depth format of %s cameras; allowed: %s",
                   Shown(text).size, Shown(text).text, is_v4l2 ? "v4l2" : "libcamera", known);
}

/// Of TOML and K= it says nothing new: both are of the images that come.
Fault ParseRectified(std::string_view text, bool& rectified) noexcept {
  if (text != "yes" && text != "no") {
    return MakeFault(Status::kInvalidUri, "rectified=%.*s is neither yes nor no", Shown(text).size,
                     Shown(text).text);
  }
  rectified = text == "yes";
  return {};
}

enum class Option : std::uint8_t {
  kFormat,
  kWidth,
  kHeight,
  kRate,
  kUnit,
  kFile,
  kCamera,
  kRectified,
  kCount
};

constexpr std::array<const char*, static_cast<std::size_t>(Option::kCount)> kOptionNames{
    "format", "width", "height", "fps", "depth_scale", "intrinsics", "K", "rectified"};

Fault SetOption(Option option, std::string_view value, CameraAddress& address) noexcept {
  const char* const name = kOptionNames[static_cast<std::size_t>(option)];
  switch (option) {
    case Option::kFormat:
      return ParseFormat(value, address);
    case Option::kWidth:
      return ParseNumber(name, value, 1, CameraAddress::kMaxSide_px, address.width_px);
    case Option::kHeight:
      return ParseNumber(name, value, 1, CameraAddress::kMaxSide_px, address.height_px);
    case Option::kRate:
      return ParseNumber(name, value, 0.1F, CameraAddress::kMaxRate_hz, address.rate_hz);
    case Option::kUnit:
      return ParseNumber(name, value, 1e-7F, 1.0F, address.unit_m);
    case Option::kFile:
      return CopyText("intrinsics", value, address.intrinsics);
    case Option::kCamera:
      return ParseCamera(value, address.camera);
    case Option::kRectified:
      return ParseRectified(value, address.rectified);
    case Option::kCount:
      break;
  }
  return {};
}

Fault ParseOption(std::string_view item, unsigned& seen, CameraAddress& address) noexcept {
  std::string_view value = item;
  const std::string_view key = TakeUntil('=', value);
  for (std::size_t i = 0; i < kOptionNames.size() && key.size() < item.size(); ++i) {
    if (key != kOptionNames[i]) continue;
    if ((seen & 1U << i) != 0) {
      return MakeFault(Status::kInvalidUri, "%s is given twice", kOptionNames[i]);
    }
    seen |= 1U << i;
    return SetOption(static_cast<Option>(i), value, address);
  }
  return MakeFault(Status::kInvalidUri,
                   "'%.*s' is no option of a camera; known: format=, width=, height=, fps=, "
                   "depth_scale=, intrinsics=, K=, rectified=",
                   Shown(item).size, Shown(item).text);
}

Fault ParseOptions(std::string_view query, CameraAddress& address) noexcept {
  unsigned seen = 0;
  while (!query.empty()) {
    const Fault fault = ParseOption(TakeUntil('&', query), seen, address);
    if (!fault.ok()) return fault;
  }
  if ((address.width_px == 0) != (address.height_px == 0)) {
    return MakeFault(Status::kInvalidUri,
                     "width and height belong together; one of them is missing");
  }
  if (address.intrinsics[0] != '\0' && address.camera.IsValid()) {
    return MakeFault(Status::kInvalidUri, "intrinsics= and K= say the same twice; leave one away");
  }
  return {};
}

Fault ParseV4l2Device(std::string_view& rest, CameraAddress& address) noexcept {
  address.kind = CameraAddress::Kind::kV4l2;
  if (rest.starts_with(kSerialKey)) {
    rest.remove_prefix(kSerialKey.size());
    // Both "serial=X?format=…" and "serial=X&format=…" are how people write it.
    const std::size_t end = std::min(rest.find_first_of("?&"), rest.size());
    const Fault fault = CopyText("serial", {rest.data(), end}, address.serial);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return fault;
  }
  const std::string_view device = TakeUntil('?', rest);
  if (!device.starts_with('/')) {
    return MakeFault(Status::kInvalidUri,
                     "'%.*s' is no V4L2 device; write v4l2:/dev/video0?… or v4l2:serial=…",
                     Shown(device).size, Shown(device).text);
  }
  return CopyText("device", device, address.device);
}

Fault ParseLibcameraDevice(std::string_view& rest, CameraAddress& address) noexcept {
  address.kind = CameraAddress::Kind::kLibcamera;
  return CopyText("libcamera's camera (a number from 0, or an id from --list-sensors)",
                  TakeUntil('?', rest), address.device);
}

}  // namespace

const char* const kCameraAddressHelp =
    "  v4l2:/dev/videoN, v4l2:serial=TEXT\n"
    "               a depth camera of the kernel (docs/cameras.md), by path or by the serial "
    "number of the USB\n"
    "               device. Options: format=Z16|Y16|Y16_BE|Y12|INZI, width=640, height=480, "
    "fps=30,\n"
    "               depth_scale=0.001 (metres per unit; known for some models), "
    "intrinsics=cam.toml or\n"
    "               K=fx,fy,cx,cy; with intrinsics=cam.yaml of ROS also rectified=yes|no: whether "
    "the driver\n"
    "               rectifies the images (no)\n"
    "  libcamera:N, libcamera:ID\n"
    "               a camera of libcamera, if built with it. Options as above, "
    "format=R16|R12|R10|\n"
    "               R12_CSI2P|R10_CSI2P\n"
    "               --list-sensors shows what there is\n";

bool IsCameraAddress(std::string_view uri) noexcept {
  return uri.starts_with(kV4l2Scheme) || uri.starts_with(kLibcameraScheme);
}

Fault ParseCameraAddress(std::string_view uri, CameraAddress& address) noexcept {
  CameraAddress parsed;
  std::string_view rest = uri;
  Fault fault;
  if (uri.starts_with(kV4l2Scheme)) {
    rest.remove_prefix(kV4l2Scheme.size());
    fault = ParseV4l2Device(rest, parsed);
  } else if (uri.starts_with(kLibcameraScheme)) {
    rest.remove_prefix(kLibcameraScheme.size());
    fault = ParseLibcameraDevice(rest, parsed);
  } else {
    return MakeFault(Status::kInvalidUri, "'%.*s' is no camera; write v4l2:… or libcamera:…",
                     Shown(uri).size, Shown(uri).text);
  }
  if (fault.ok()) fault = ParseOptions(rest, parsed);
  if (fault.ok()) address = parsed;
  return fault;
}

}  // namespace disflow::posix

// SPDX-License-Identifier: BSD-3-Clause
#include "uvc_descriptors.h"

#include <array>
#include <initializer_list>
#include <string_view>

namespace disflow::hil {
namespace {

/// Little-endian fields in a row; the first byte of a descriptor is its length.
class Descriptor {
 public:
  Descriptor(std::uint8_t type, std::initializer_list<std::uint8_t> fields) {
    Append({0, type}).Append(fields);
  }
  Descriptor& Add8(unsigned value) {
    bytes_.push_back(static_cast<std::uint8_t>(value));
    return *this;
  }
  Descriptor& Add16(unsigned value) { return Add8(value & 0xFFU).Add8(value >> 8U); }
  Descriptor& Add32(std::uint32_t value) { return Add16(value & 0xFFFFU).Add16(value >> 16U); }
  Descriptor& Append(std::initializer_list<std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) bytes_.push_back(byte);
    return *this;
  }
  [[nodiscard]] Bytes Finish() {
    bytes_[0] = static_cast<std::uint8_t>(bytes_.size());
    return bytes_;
  }

 private:
  Bytes bytes_;
};

// Descriptor types of USB 2.0 and of UVC 1.0.
constexpr std::uint8_t kDevice = 1;
constexpr std::uint8_t kConfiguration = 2;
constexpr std::uint8_t kString = 3;
constexpr std::uint8_t kInterface = 4;
constexpr std::uint8_t kEndpoint = 5;
constexpr std::uint8_t kAssociation = 11;
constexpr std::uint8_t kClassInterface = 0x24;

constexpr std::uint8_t kVideoClass = 14;
constexpr std::uint8_t kControlSubclass = 1;
constexpr std::uint8_t kStreamSubclass = 2;
constexpr unsigned kMaxPacket = 512;  // high speed, bulk

struct FormatGuid {
  std::string_view name;
  std::uint8_t bits;
  std::array<std::uint8_t, 16> guid;
};

// The identifiers by which uvcvideo knows the formats.
constexpr std::array kFormats{
    FormatGuid{"Z16",
               16,
               {'I', 'N', 'V', 'Z', 0x90, 0x2d, 0x58, 0x4a, 0x92, 0x0b, 0x77, 0x3f, 0x1f, 0x2c,
                0x55, 0x6b}},
    FormatGuid{"INZI",
               32,
               {'I', 'N', 'Z', 'I', 0x66, 0x1a, 0x42, 0xa2, 0x90, 0x65, 0xd0, 0x18, 0x14, 0xa8,
                0xef, 0x8a}},
    FormatGuid{"Y16",
               16,
               {'Y', '1', '6', ' ', 0x00, 0x00, 0x10, 0x00, 0x80, 0x00, 0x00, 0xaa, 0x00, 0x38,
                0x9b, 0x71}},
    FormatGuid{"Y12",
               16,
               {'Y', '1', '2', ' ', 0x00, 0x00, 0x10, 0x00, 0x80, 0x00, 0x00, 0xaa, 0x00, 0x38,
                0x9b, 0x71}},
    FormatGuid{"YUYV",
               16,
               {'Y', 'U', 'Y', '2', 0x00, 0x00, 0x10, 0x00, 0x80, 0x00, 0x00, 0xaa, 0x00, 0x38,
                0x9b, 0x71}},
};

const FormatGuid* Find(std::string_view name) {
  for (const FormatGuid& format : kFormats) {
    if (format.name == name) return &format;
  }
  return nullptr;
}

void Append(Bytes& all, const Bytes& more) { all.insert(all.end(), more.begin(), more.end()); }

Bytes ControlInterface() {
  Bytes all = Descriptor(kInterface, {0, 0, 0, kVideoClass, kControlSubclass, 0, 0}).Finish();
  Bytes units;
  // A camera, and the stream that it goes to.
  Append(units, Descriptor(kClassInterface, {2, 1})
                    .Add16(0x0201)
                    .Add8(0)
                    .Add8(0)
                    .Add16(0)
                    .Add16(0)
                    .Add16(0)
                    .Add8(3)
                    .Append({0, 0, 0})
                    .Finish());
  Append(units, Descriptor(kClassInterface, {3, 2}).Add16(0x0101).Append({0, 1, 0}).Finish());
  constexpr unsigned kHeaderBytes = 13;
  Append(all, Descriptor(kClassInterface, {1})
                  .Add16(0x0100)  // UVC 1.0
                  .Add16(kHeaderBytes + static_cast<unsigned>(units.size()))
                  .Add32(48'000'000)
                  .Append({1, kStreamInterface})
                  .Finish());
  Append(all, units);
  return all;
}

Bytes StreamFormats(const CameraModelOptions& options) {
  const FormatGuid& format = *Find(options.format);
  Descriptor description(kClassInterface, {4, 1, 1});
  for (const std::uint8_t byte : format.guid) description.Add8(byte);
  Bytes all = description.Append({format.bits, 1, 0, 0, 0, 0}).Finish();
  const std::uint32_t bits_per_s =
      options.image_bytes() * 8U * static_cast<unsigned>(options.rate_hz);
  Append(all, Descriptor(kClassInterface, {5, 1, 0})
                  .Add16(static_cast<unsigned>(options.width_px))
                  .Add16(static_cast<unsigned>(options.height_px))
                  .Add32(bits_per_s)
                  .Add32(bits_per_s)
                  .Add32(options.image_bytes())
                  .Add32(options.interval_100ns())
                  .Add8(1)
                  .Add32(options.interval_100ns())
                  .Finish());
  return all;
}

Bytes StreamInterface(const CameraModelOptions& options) {
  Bytes all =
      Descriptor(kInterface, {kStreamInterface, 0, 1, kVideoClass, kStreamSubclass, 0, 0}).Finish();
  const Bytes formats = StreamFormats(options);
  constexpr unsigned kHeaderBytes = 14;
  constexpr std::uint8_t kAddress = 0x80 | kStreamEndpoint;
  Append(all, Descriptor(kClassInterface, {1, 1})
                  .Add16(kHeaderBytes + static_cast<unsigned>(formats.size()))
                  .Append({kAddress, 0, 2, 0, 0, 0, 1, 0})
                  .Finish());
  Append(all, formats);
  Append(all, Descriptor(kEndpoint, {kAddress, 2}).Add16(kMaxPacket).Add8(0).Finish());
  return all;
}

}  // namespace

bool KnowsFormat(const std::string& format) { return Find(format) != nullptr; }

Bytes DeviceDescriptor(const CameraModelOptions& options) {
  return Descriptor(kDevice, {0x00, 0x02, 0xEF, 2, 1, 64})
      .Add16(options.vendor_id)
      .Add16(options.product_id)
      .Add16(0x0100)
      .Append({1, 2, 3, 1})
      .Finish();
}

Bytes ConfigurationDescriptor(const CameraModelOptions& options) {
  Bytes body = Descriptor(kAssociation, {0, 2, kVideoClass, 3, 0, 2}).Finish();
  Append(body, ControlInterface());
  Append(body, StreamInterface(options));
  constexpr unsigned kOwnBytes = 9;
  Bytes all = Descriptor(kConfiguration, {})
                  .Add16(kOwnBytes + static_cast<unsigned>(body.size()))
                  .Append({2, 1, 0, 0x80, 250})
                  .Finish();
  Append(all, body);
  return all;
}

Bytes StringDescriptor(const CameraModelOptions& options, int index) {
  Descriptor descriptor(kString, {});
  if (index == 0) return descriptor.Add16(0x0409).Finish();
  const std::string text = index == 1   ? "DisFlow"
                           : index == 2 ? "Emulated depth camera"
                                        : options.serial;
  for (const char letter : text) descriptor.Add16(static_cast<std::uint8_t>(letter));
  return descriptor.Finish();
}

Bytes StreamControl(const CameraModelOptions& options) {
  Bytes control{0, 0, 1, 1};
  const auto add32 = [&control](std::uint32_t value) {
    for (int i = 0; i < 4; ++i) control.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  };
  add32(options.interval_100ns());
  control.resize(18);  // key frames, quality, delay
  add32(options.image_bytes());
  add32(options.payload_bytes());
  return control;
}

}  // namespace disflow::hil

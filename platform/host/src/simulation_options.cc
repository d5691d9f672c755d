// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/simulation_options.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "disflow/host/option_value.h"
#include "disflow/host/stereo_camera.h"

namespace disflow::host {
namespace {

constexpr std::array kObjects{Choice<ObjectKind>{"box", ObjectKind::kBox},
                              Choice<ObjectKind>{"bottle", ObjectKind::kBottle},
                              Choice<ObjectKind>{"can", ObjectKind::kCan},
                              Choice<ObjectKind>{"doughnut", ObjectKind::kDoughnut},
                              Choice<ObjectKind>{"rounded-box", ObjectKind::kRoundedBox},
                              Choice<ObjectKind>{"flat-box", ObjectKind::kFlatBox},
                              Choice<ObjectKind>{"mug", ObjectKind::kMug},
                              Choice<ObjectKind>{"bowl", ObjectKind::kBowl},
                              Choice<ObjectKind>{"tube", ObjectKind::kTube},
                              Choice<ObjectKind>{"superellipsoid", ObjectKind::kSuperellipsoid},
                              Choice<ObjectKind>{"screwdriver", ObjectKind::kScrewdriver},
                              Choice<ObjectKind>{"bracket", ObjectKind::kBracket},
                              Choice<ObjectKind>{"spray-bottle", ObjectKind::kSprayBottle}};
constexpr std::array kMotions{Choice<MotionKind>{"static", MotionKind::kStatic},
                              Choice<MotionKind>{"moderate", MotionKind::kModerate},
                              Choice<MotionKind>{"fast", MotionKind::kFast},
                              Choice<MotionKind>{"rotate360", MotionKind::kRotate360},
                              Choice<MotionKind>{"flying", MotionKind::kFlying},
                              Choice<MotionKind>{"leaving", MotionKind::kLeaving}};
constexpr std::array kNoises{Choice<NoiseKind>{"clean", NoiseKind::kClean},
                             Choice<NoiseKind>{"white", NoiseKind::kWhite},
                             Choice<NoiseKind>{"d415", NoiseKind::kD415},
                             Choice<NoiseKind>{"kinect", NoiseKind::kKinect},
                             Choice<NoiseKind>{"tof", NoiseKind::kTof},
                             Choice<NoiseKind>{"stereo", NoiseKind::kStereo},
                             Choice<NoiseKind>{"stereo-raw", NoiseKind::kStereoRaw}};
constexpr std::array kOccluders{Choice<OccluderKind>{"none", OccluderKind::kNone},
                                Choice<OccluderKind>{"arm", OccluderKind::kArm},
                                Choice<OccluderKind>{"curtain", OccluderKind::kCurtain},
                                Choice<OccluderKind>{"hand", OccluderKind::kHand}};
constexpr std::array kSupports{Choice<SupportKind>{"none", SupportKind::kNone},
                               Choice<SupportKind>{"table", SupportKind::kTable}};
constexpr std::array kCameras{Choice<CameraKind>{"static", CameraKind::kStatic},
                              Choice<CameraKind>{"moving", CameraKind::kMoving}};
constexpr std::array kMasks{
    Choice<MaskKind>{"gt", MaskKind::kGt}, Choice<MaskKind>{"sloppy", MaskKind::kSloppy},
    Choice<MaskKind>{"leaking", MaskKind::kLeaking}, Choice<MaskKind>{"none", MaskKind::kNone}};
constexpr std::array kFormats{Choice<DepthFormat>{"float", DepthFormat::kFloat32},
                              Choice<DepthFormat>{"z16", DepthFormat::kUint16}};

template <class Number>
struct Range {
  Number min;
  Number max;
};
constexpr Range<std::uint64_t> kSeed{0, std::numeric_limits<std::uint32_t>::max()};
constexpr Range<int> kFrames{1, 1000000};
constexpr Range<double> kFps{1.0, 1000.0};
constexpr Range<int> kSide{32, 4096};
constexpr Range<double> kFocal{16.0, 16384.0};
constexpr Range<double> kShare{0.0, 0.9};
constexpr Range<double> kJitter{0.0, 1000.0};
constexpr Range<double> kTime{0.0, 3600.0};
constexpr Range<int> kDelay{0, 30};
constexpr Range<int> kGrow{-40, 40};
constexpr Range<double> kEdge{0.0, 14.0};
constexpr Range<double> kBulge{0.0, 3.0};
constexpr Range<double> kUneven{0.0, 2.0};
constexpr Range<double> kDistance{0.0, 4.0};
constexpr Range<int> kHide{0, static_cast<int>(kMaxSimulatedObjects)};

constexpr std::string_view kObjPrefix = "obj:";

template <class Value, std::size_t kCount>
constexpr std::span<const Choice<Value>> All(const std::array<Choice<Value>, kCount>& choices) {
  return choices;
}

/// One option: its key, how it is set and what is allowed.
struct Option {
  std::string_view key;
  hal::Fault (*set)(std::string_view key, std::string_view value, SimulationOptions& options);
  std::string (*allowed)();
};

template <auto kMember, const auto& kChoices>
constexpr Option ChoiceOption(std::string_view key) {
  return {key,
          [](std::string_view k, std::string_view value, SimulationOptions& options) {
            return ParseChoice(k, value, All(kChoices), options.*kMember);
          },
          [] { return ListChoices(All(kChoices)); }};
}

template <auto kMember, const auto& kRange>
constexpr Option NumberOption(std::string_view key) {
  return {key,
          [](std::string_view k, std::string_view value, SimulationOptions& options) {
            return ParseNumber(k, value, kRange.min, kRange.max, options.*kMember);
          },
          [] {
            std::array<char, 64> text{};
            (void)std::snprintf(text.data(), text.size(), "%.10g to %.10g",
                                static_cast<double>(kRange.min), static_cast<double>(kRange.max));
            return std::string(text.data());
          }};
}

using Options = SimulationOptions;

constexpr Option NoiseOption() {
  constexpr Option kPlain = ChoiceOption<&Options::noise, kNoises>("noise");
  return {kPlain.key,
          [](std::string_view key, std::string_view value, SimulationOptions& options) {
            Options wanted = options;
            const hal::Fault fault = kPlain.set(key, value, wanted);
            if (!fault.ok()) return fault;
            const bool is_stereo =
                wanted.noise == NoiseKind::kStereo || wanted.noise == NoiseKind::kStereoRaw;
            if (is_stereo && !StereoIsAvailable()) {
              return hal::MakeFault(
                  Status::kUnsupported,
                  "noise=%.*s: built without OpenCV: install libopencv-calib3d-dev, build again",
                  static_cast<int>(value.size()), value.data());
            }
            options.noise = wanted.noise;
            return hal::Fault{};
          },
          kPlain.allowed};
}

constexpr std::array kOptions{ChoiceOption<&Options::motion, kMotions>("motion"),
                              NoiseOption(),
                              NumberOption<&Options::seed, kSeed>("seed"),
                              NumberOption<&Options::frames, kFrames>("frames"),
                              NumberOption<&Options::fps, kFps>("fps"),
                              NumberOption<&Options::width_px, kSide>("width"),
                              NumberOption<&Options::height_px, kSide>("height"),
                              NumberOption<&Options::focal_px, kFocal>("focal"),
                              ChoiceOption<&Options::occluder, kOccluders>("occluder"),
                              ChoiceOption<&Options::support, kSupports>("support"),
                              NumberOption<&Options::hide, kHide>("hide"),
                              NumberOption<&Options::edge_mm, kEdge>("edge_mm"),
                              NumberOption<&Options::bulge_mm, kBulge>("bulge_mm"),
                              NumberOption<&Options::uneven_mm, kUneven>("uneven_mm"),
                              NumberOption<&Options::distance_m, kDistance>("distance_m"),
                              NumberOption<&Options::drop, kShare>("drop"),
                              NumberOption<&Options::repeat, kShare>("repeat"),
                              NumberOption<&Options::jitter_ms, kJitter>("jitter_ms"),
                              NumberOption<&Options::blank_s, kTime>("blank_s"),
                              NumberOption<&Options::blank_at_s, kTime>("blank_at_s"),
                              ChoiceOption<&Options::camera, kCameras>("camera"),
                              ChoiceOption<&Options::mask, kMasks>("mask"),
                              NumberOption<&Options::mask_delay, kDelay>("mask_delay"),
                              NumberOption<&Options::mask_grow_px, kGrow>("mask_grow_px"),
                              NumberOption<&Options::mask_flicker, kShare>("mask_flicker"),
                              ChoiceOption<&Options::format, kFormats>("format")};

std::string ListKeys() {
  std::string list;
  for (const Option& option : kOptions) {
    if (!list.empty()) list += ", ";
    list += option.key;
  }
  return list;
}

hal::Fault ParseShape(std::string_view name, SimulatedShape& shape) {
  if (name.starts_with(kObjPrefix) && name.size() > kObjPrefix.size()) {
    shape = {ObjectKind::kObjFile, std::string(name.substr(kObjPrefix.size()))};
    return {};
  }
  for (const auto& [word, kind] : kObjects) {
    if (word != name) continue;
    shape = {kind, {}};
    return {};
  }
  return hal::MakeFault(
      Status::kInvalidUri, "'%.*s' is no simulated object; known: %s, obj:FILE.obj",
      static_cast<int>(name.size()), name.data(), ListChoices(All(kObjects)).c_str());
}

/// Where the first of several names ends. A + that no name follows belongs to a file's name.
std::size_t EndOfName(std::string_view names) {
  for (std::size_t plus = names.find('+'); plus < names.size(); plus = names.find('+', plus + 1)) {
    const std::string_view rest = names.substr(plus + 1);
    const bool is_word = std::any_of(kObjects.begin(), kObjects.end(), [rest](const auto& choice) {
      return rest.substr(0, rest.find('+')) == choice.word;
    });
    if (is_word || rest.starts_with(kObjPrefix) || !names.starts_with(kObjPrefix)) return plus;
  }
  return names.size();
}

std::string NameOf(const SimulatedShape& shape) {
  for (const auto& [word, kind] : kObjects) {
    if (kind == shape.object) return std::string(word);
  }
  const std::string& file = shape.obj_file;
  const std::size_t slash = file.rfind('/');
  const std::string name = slash == std::string::npos ? file : file.substr(slash + 1);
  return name.substr(0, name.rfind('.'));
}

}  // namespace

PinholeCamera SimulatedCamera(const SimulationOptions& options) {
  // Fast-YCB's camera: f = 1229.43 px at 1280 px width.
  constexpr double kFocalPerWidth = 1229.43 / 1280.0;
  const double focal_px =
      options.focal_px > 0.0 ? options.focal_px : kFocalPerWidth * options.width_px;
  const auto focal = static_cast<float>(focal_px);
  return {focal, focal, 0.5F * static_cast<float>(options.width_px),
          0.5F * static_cast<float>(options.height_px)};
}

hal::Fault SetSimulationOption(std::string_view key, std::string_view value,
                               SimulationOptions& options) {
  for (const Option& option : kOptions) {
    if (option.key == key) return option.set(key, value, options);
  }
  return hal::MakeFault(Status::kInvalidUri, "the simulated camera has no option %.*s; known: %s",
                        static_cast<int>(key.size()), key.data(), ListKeys().c_str());
}

hal::Fault SetSimulationObject(std::string_view name, SimulationOptions& options) {
  std::vector<SimulatedShape> shapes;
  for (;;) {
    const std::size_t end = EndOfName(name);
    const hal::Fault fault = ParseShape(name.substr(0, end), shapes.emplace_back());
    if (!fault.ok()) return fault;
    if (end == name.size()) break;
    name.remove_prefix(end + 1);
  }
  if (shapes.size() > kMaxSimulatedObjects) {
    return hal::MakeFault(Status::kInvalidUri, "%zu simulated objects are too many; %zu have room",
                          shapes.size(), kMaxSimulatedObjects);
  }
  options.object = shapes.front().object;
  options.obj_file = shapes.front().obj_file;
  options.further.assign(shapes.begin() + 1, shapes.end());
  return {};
}

std::vector<SimulatedShape> ObjectShapes(const SimulationOptions& options) {
  std::vector<SimulatedShape> shapes = {{options.object, options.obj_file}};
  shapes.insert(shapes.end(), options.further.begin(), options.further.end());
  return shapes;
}

hal::Fault ParseSimulationUri(const Uri& uri, SimulationOptions& options) {
  SimulationOptions parsed;
  hal::Fault fault = SetSimulationObject(uri.path, parsed);
  for (const auto& [key, value] : uri.query) {
    if (fault.ok()) fault = SetSimulationOption(key, value, parsed);
  }
  if (fault.ok()) options = parsed;
  return fault;
}

std::string ObjectName(const SimulationOptions& options) { return ObjectNames(options).front(); }

std::vector<std::string> ObjectNames(const SimulationOptions& options) {
  std::vector<std::string> names;
  for (const SimulatedShape& shape : ObjectShapes(options)) {
    const std::string plain = NameOf(shape);
    std::string name = plain;
    for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number)
      name = plain + std::to_string(number);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string_view> ListSimulationObjects() {
  std::vector<std::string_view> names;
  names.reserve(std::size(kObjects));
  for (const Choice<ObjectKind>& object : kObjects) names.push_back(object.word);
  return names;
}

std::vector<SimulationOptionText> ListSimulationOptions() {
  std::vector<SimulationOptionText> list;
  list.reserve(std::size(kOptions));
  for (const Option& option : kOptions) list.push_back({option.key, option.allowed()});
  return list;
}

std::string SimulationOptionsHelp() {
  std::string help;
  for (const auto& [key, allowed] : ListSimulationOptions()) {
    help.append("                 ").append(key).append("=").append(allowed).append("\n");
  }
  return help;
}

}  // namespace disflow::host

// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/host/obj_file.h"
#include "disflow/host/sequence_writer.h"
#include "disflow/host/simulated_object.h"
#include "disflow/host/simulation.h"
#include "empty_values.h"

namespace {

using disflow::DepthFrame;
using disflow::hal::Fault;
using disflow::host::SimulationOptions;
namespace fs = std::filesystem;

enum ExitStatus : int { kDone = 0, kWrongUsage = 2, kInputFailed = 3, kOutputFailed = 4 };

constexpr const char* kDescription =
    "Writes a sequence of a simulated depth camera in the Fast-YCB layout, with ground truth.";

constexpr const char* kFooter =
    "OUT_DIR receives cam_K.json, depth/, masks/SET/, data.txt, gt/poses.txt, gt/velocities.txt,\n"
    "gt/model.obj and, with a moving camera, T_wc.txt. The same arguments give the same bytes.\n"
    "With --mask-delay, --mask-grow-px, --mask-flicker or --mask leaking the disturbed masks go "
    "to\n"
    "masks/disturbed/. Stereo cameras leave their left image in infrared/.\n"
    "Of several objects each has a folder of its name in gt/ and masks of its name.\n"
    "\n"
    "Exit status: 0 done, 2 wrong usage, 3 an input failed, 4 an output failed.";

/// What the help says of an option of the simulation beside the values that it takes.
struct Explanation {
  std::string_view key;
  const char* text;
};
constexpr std::array kExplanations{
    Explanation{"motion", "How the object moves [moderate]"},
    Explanation{"noise", "What the camera adds [clean]"},
    Explanation{"seed", "Number that all randomness follows from [1]"},
    Explanation{"frames", "Images taken, dropped ones included [300]"},
    Explanation{"fps", "Images per second [30]"},
    Explanation{"width", "Image width in pixels [640]"},
    Explanation{"height", "Image height in pixels [360]"},
    Explanation{"focal", "Focal length in pixels [as Fast-YCB's camera at this width]"},
    Explanation{"occluder", "What passes in front of the object [none]"},
    Explanation{"support", "What the object stands on [none]"},
    Explanation{"hide", "Object that is not there from 1 to 2 s, from 1 on [0: none]"},
    Explanation{"edge_mm", "Radius of the edges of rounded-box and flat-box [0: 4 and 2 mm]"},
    Explanation{"bulge_mm", "By which the faces of boxes stand out in the middle [0]"},
    Explanation{"uneven_mm", "Standard deviation of surfaces from the drawn ones [0]"},
    Explanation{"distance_m", "The objects' centres come no nearer than this [0: 0.55 m]"},
    Explanation{"drop", "Share of images that are lost [0]"},
    Explanation{"repeat", "Share of images that are the one before again [0]"},
    Explanation{"jitter_ms", "Stamps are off by up to this, ms [0]"},
    Explanation{"blank_s", "For so long images have no depth, masks no pixels [0]"},
    Explanation{"blank_at_s", "From then on [3]"},
    Explanation{"mask_delay", "Masks are late by so many frames [0]"},
    Explanation{"mask_grow_px", "Masks reach too far, or (< 0) not far enough [0]"},
    Explanation{"mask_flicker", "Share of masks that are missing or cut [0]"},
    Explanation{"camera", "Whether the camera moves [static]"},
    Explanation{"format", "Depth as float32 metres, or rounded to millimetres [float]"}};

/// Several at once, and so not set like the others.
constexpr std::string_view kMaskKey = "mask";

std::string ObjectNames() {
  std::string names;
  for (const std::string_view name : disflow::host::ListSimulationObjects()) {
    names.append(names.empty() ? "" : ", ").append(name);
  }
  return names;
}

std::string HelpOf(const disflow::host::SimulationOptionText& option) {
  std::string help;
  for (const Explanation& explanation : kExplanations) {
    if (explanation.key == option.key) help = std::string(explanation.text) + ": ";
  }
  return help + option.allowed;
}

struct Arguments {
  fs::path out_dir;
  std::string object = "box";
  std::map<std::string, std::string> options;  ///< Key and value of what was given.
  std::vector<std::string> mask_sets{"gt"};
  bool force = false;
};

int Complain(const Fault& fault, ExitStatus status) {
  std::fprintf(stderr, "disflow_sim: %s\n", fault.message);
  return status;
}

Fault MakeOptions(const Arguments& arguments, SimulationOptions& options) {
  const bool is_file = arguments.object.ends_with(".obj") && !arguments.object.starts_with("obj:");
  Fault fault = SetSimulationObject((is_file ? "obj:" : "") + arguments.object, options);
  for (const auto& [key, value] : arguments.options) {
    if (fault.ok() && !value.empty()) fault = SetSimulationOption(key, value, options);
  }
  bool leaks = false;
  for (const std::string& set : arguments.mask_sets) {
    if (fault.ok()) fault = SetSimulationOption(kMaskKey, set, options);
    leaks = leaks || options.mask == disflow::host::MaskKind::kLeaking;
  }
  // Of several sets this is the one that the simulation has to be told of.
  if (leaks) options.mask = disflow::host::MaskKind::kLeaking;
  return fault;
}

/// A set of masks and what it is called on disk.
struct MaskSet {
  const char* name;
  disflow::MaskView mask;
};

std::vector<MaskSet> MasksOf(const disflow::host::Simulation& simulation,
                             const std::vector<std::string>& wanted) {
  std::vector<MaskSet> sets;
  for (const std::string& set : wanted) {
    if (set == "gt") sets.push_back({"gt", simulation.gt_mask()});
    if (set == "sloppy") sets.push_back({"sloppy", simulation.sloppy_mask()});
  }
  // A mask that is missing has no file: whoever reads the sequence holds the one before.
  if (simulation.HasDisturbedMask() && simulation.mask().given())
    sets.push_back({"disturbed", simulation.mask()});
  return sets;
}

/// Masks and truth of one of several objects.
Fault WriteObject(const disflow::host::Simulation& simulation, int index, std::size_t object,
                  const std::vector<std::string>& mask_sets,
                  disflow::host::SequenceWriter& writer) {
  const std::string name = ObjectNames(simulation.options())[object];
  Fault fault = writer.AddTruthOf(name, simulation.TruthAt(index, object).object);
  for (auto [set, mask] : MasksOf(simulation, mask_sets)) {
    mask.label = static_cast<std::uint8_t>(object + 1);
    if (fault.ok()) fault = writer.AddMaskOf(name, set, mask);
  }
  return fault;
}

Fault WriteFrame(disflow::host::Simulation& simulation, int index,
                 const std::vector<std::string>& mask_sets, disflow::host::SequenceWriter& writer) {
  DepthFrame frame;
  simulation.Render(index, frame);
  Fault fault = writer.AddFrame(frame);
  const disflow::MaskView infrared = simulation.infrared();
  if (fault.ok() && infrared.given()) fault = writer.AddInfrared(infrared);
  if (simulation.objects() > 1) {
    for (std::size_t i = 0; i < simulation.objects() && fault.ok(); ++i)
      fault = WriteObject(simulation, index, i, mask_sets, writer);
    return fault;
  }
  for (const auto& [set, mask] : MasksOf(simulation, mask_sets)) {
    if (fault.ok()) fault = writer.AddMask(set, mask);
  }
  if (fault.ok()) fault = writer.AddTruth(simulation.TruthAt(index).object);
  return fault;
}

/// Where the truth of an object is. It is made, if need be.
fs::path TruthFolder(const fs::path& out_dir, const std::vector<std::string>& names,
                     std::size_t object) {
  fs::path folder = names.size() > 1 ? out_dir / "gt" / names[object] : out_dir / "gt";
  std::error_code error;  // Whoever writes there says what is wrong.
  fs::create_directories(folder, error);
  return folder;
}

Fault OpenWriter(const Arguments& arguments, const std::string& object,
                 disflow::host::SequenceWriter& writer) {
  const Fault fault = writer.Open(arguments.out_dir, object, arguments.force);
  if (fault.status != disflow::Status::kBusy || arguments.force) return fault;
  return disflow::hal::MakeFault(
      fault.status,
      "%s: is not empty; choose another folder, or --force if it is a sequence to be replaced",
      arguments.out_dir.c_str());
}

Fault WriteSequence(disflow::host::Simulation& simulation, const Arguments& arguments) {
  disflow::host::SequenceWriter writer;
  const SimulationOptions& options = simulation.options();
  const std::vector<std::string> names = ObjectNames(options);
  Fault fault = OpenWriter(arguments, ObjectName(options), writer);
  // First: a sequence that is cut short can be evaluated as far as it goes.
  for (std::size_t i = 0; i < names.size() && fault.ok(); ++i)
    fault = WriteObj(TruthFolder(arguments.out_dir, names, i) / "model.obj", simulation.mesh(i));
  for (int index = 0; index < options.frames && fault.ok(); ++index) {
    if (simulation.IsDropped(index)) continue;
    fault = WriteFrame(simulation, index, arguments.mask_sets, writer);
  }
  if (fault.ok()) fault = writer.Finish();
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  if (fault.ok()) {
    std::printf("%d frames of %s in %s\n", writer.frame_count(), all.c_str(),
                arguments.out_dir.c_str());
  }
  return fault;
}

int Run(const Arguments& arguments) {
  SimulationOptions options;
  Fault fault = MakeOptions(arguments, options);
  if (!fault.ok()) return Complain(fault, kWrongUsage);
  std::vector<disflow::host::TriangleMesh> meshes;
  fault = LoadSimulatedObjects(options, meshes);
  if (!fault.ok()) return Complain(fault, kInputFailed);
  disflow::host::Simulation simulation(options, std::move(meshes));
  fault = WriteSequence(simulation, arguments);
  return fault.ok() ? kDone : Complain(fault, kOutputFailed);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(kDescription, "disflow_sim");
  app.footer(kFooter);
  app.set_version_flag("--version", "disflow_sim " DISFLOW_VERSION " (" DISFLOW_BUILD ")");
  app.add_option("OUT_DIR", arguments.out_dir, "Folder to write; created if it does not exist")
      ->required();
  app.add_option("--object", arguments.object,
                 ObjectNames() + " or FILE.obj, or several joined by +, the nearest first [box]");
  for (const auto& option : disflow::host::ListSimulationOptions()) {
    if (option.key == kMaskKey) continue;
    const std::string key(option.key);
    app.add_option("--" + key, arguments.options[key], HelpOf(option));
  }
  app.add_option("--mask", arguments.mask_sets,
                 "Mask sets to write: gt, sloppy, leaking, none [gt]")
      ->delimiter(',');
  app.add_flag("--force", arguments.force,
               "Replace a sequence that is in OUT_DIR already; anything else is left alone");
  try {
    app.parse(argc, argv);
    disflow::apps::RefuseEmptyValues(app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  try {
    return Run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "disflow_sim: %s\n", error.what());
    return kInputFailed;
  }
}

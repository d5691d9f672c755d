// SPDX-License-Identifier: BSD-3-Clause
#include "sequence.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "depth_images.h"
#include "disflow/host/sequence_layout.h"
#include "disflow/host/simulated_object.h"
#include "disflow/host/simulation.h"
#include "errors.h"
#include "model_file.h"
#include "ply_file.h"
#include "text_file.h"
#include "units.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsPerNs = 1e-9;

void RequireOk(const hal::Fault& fault) {
  if (!fault.ok()) throw InputError(fault.message);
}

/// The data set's own model, in millimetres.
void FindBopModel(const fs::path& dir, int id, Sequence& sequence) {
  const auto [for_judging, all] = host::BopModelFolders(dir);
  const std::string name = Format("obj_%06d.ply", id);
  fs::path file = for_judging / name;
  if (!fs::exists(file)) file = all / name;
  sequence.model_name = file.string();
  if (!fs::exists(file)) return;
  RequireRegularFile(file);
  constexpr double kMetresPerMillimetre = 1e-3;
  sequence.model = LoadPly(file);
  for (Vec3d& vertex : sequence.model->vertices) vertex *= kMetresPerMillimetre;
}

Sequence OpenBopScene(const fs::path& dir, const std::string& object) {
  Sequence sequence;
  int id = 0;
  sequence.truth = LoadBopTruth(dir, object, id);
  FindBopModel(dir, id, sequence);
  return sequence;
}

Sequence OpenFolder(const fs::path& dir, const std::string& object) {
  if (IsBopScene(dir)) return OpenBopScene(dir, object);
  Sequence sequence;
  sequence.truth = LoadGroundTruth(dir, object);
  const fs::path file = TruthFolder(dir, object) / "model.obj";
  sequence.model_name = file.string();
  RequireRegularFile(file);
  if (fs::exists(file)) sequence.model = LoadModel(file);
  if (fs::exists(dir / "cam_K.json")) {
    // Opened when first asked for: most evaluations never look at the images.
    sequence.image = [dir, images = std::make_shared<std::optional<DepthImages>>(),
                      indices =
                          sequence.truth.file_indices](std::size_t k) -> std::optional<DepthFrame> {
      if (!images->has_value()) images->emplace(dir);
      if (!(*images)->Has(indices[k])) return std::nullopt;
      return (*images)->Load(indices[k]);
    };
  }
  return sequence;
}

/// @return Its number, from 0.
std::size_t FindObject(const host::SimulationOptions& options, const std::string& object) {
  const std::vector<std::string> names = ObjectNames(options);
  if (object.empty() && names.size() == 1) return 0;
  const auto found = std::find(names.begin(), names.end(), object);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string list;
  for (const std::string& name : names) list += " " + name;
  throw InputError("choose with --object one of:" + list);
}

Sequence OpenSimulation(const std::string& address, const std::string& object) {
  host::Uri uri;
  RequireOk(host::ParseUri(address, uri));
  host::SimulationOptions options;
  RequireOk(ParseSimulationUri(uri, options));
  const std::size_t number = FindObject(options, object);
  std::vector<host::TriangleMesh> meshes;
  RequireOk(LoadSimulatedObjects(options, meshes));

  Sequence sequence;
  sequence.model_name = ObjectNames(options)[number];
  sequence.model.emplace();
  sequence.model->vertices = meshes[number].vertices;
  sequence.model->triangles = meshes[number].triangles;
  const auto simulation = std::make_shared<host::Simulation>(options, std::move(meshes));
  for (int index = 0; index < options.frames; ++index) {
    if (simulation->IsDropped(index)) continue;
    const host::FrameTruth truth = simulation->TruthAt(index, number);
    sequence.truth.T_ct.emplace_back(truth.object.pose.rotation(), truth.object.pose.translation());
    sequence.truth.twists.push_back({truth.object.linear_mps, truth.object.angular_rps});
    sequence.truth.file_indices.push_back(index);
    sequence.truth.stamps_s.push_back(kSecondsPerNs * static_cast<double>(truth.stamp_ns));
  }
  sequence.image = [simulation, indices = sequence.truth.file_indices](
                       std::size_t k) -> std::optional<DepthFrame> {
    DepthFrame frame;
    simulation->Render(indices[k], frame);
    return frame;
  };
  return sequence;
}

}  // namespace

Sequence OpenSequence(const std::string& address, const fs::path& model_file,
                      const std::string& object) {
  Sequence sequence = address.starts_with("sim:") ? OpenSimulation(address, object)
                                                  : OpenFolder(fs::path(address), object);
  if (!model_file.empty()) {
    sequence.model_name = model_file.string();
    sequence.model = LoadModel(model_file);
  }
  if (!sequence.model) {
    throw InputError(fs::path(sequence.model_name),
                     "does not exist; name the object's model with --model");
  }
  return sequence;
}

}  // namespace disflow::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "sequence.h"

#include <memory>
#include <utility>

#include "depth_images.h"
#include "disflow/host/simulated_object.h"
#include "disflow/host/simulation.h"
#include "errors.h"
#include "model_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsPerNs = 1e-9;

void RequireOk(const hal::Fault& fault) {
  if (!fault.ok()) throw InputError(fault.message);
}

Sequence OpenFolder(const fs::path& dir) {
  Sequence sequence;
  sequence.truth = LoadGroundTruth(dir);
  if (const fs::path file = dir / "gt" / "model.obj"; fs::exists(file)) {
    sequence.model_name = file.string();
    sequence.model = LoadModel(file);
  }
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

Sequence OpenSimulation(const std::string& address) {
  host::Uri uri;
  RequireOk(host::ParseUri(address, uri));
  host::SimulationOptions options;
  RequireOk(ParseSimulationUri(uri, options));
  host::TriangleMesh mesh;
  RequireOk(LoadSimulatedObject(options, mesh));

  Sequence sequence;
  sequence.model_name = ObjectName(options);
  sequence.model.emplace();
  sequence.model->vertices = mesh.vertices;
  sequence.model->triangles = mesh.triangles;
  const auto simulation = std::make_shared<host::Simulation>(options, std::move(mesh));
  for (int index = 0; index < options.frames; ++index) {
    if (simulation->IsDropped(index)) continue;
    const host::FrameTruth truth = simulation->TruthAt(index);
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

Sequence OpenSequence(const std::string& address, const fs::path& model_file) {
  Sequence sequence =
      address.starts_with("sim:") ? OpenSimulation(address) : OpenFolder(fs::path(address));
  if (!model_file.empty()) {
    sequence.model_name = model_file.string();
    sequence.model = LoadModel(model_file);
  }
  if (!sequence.model) {
    throw InputError(fs::path(address) / "gt" / "model.obj",
                     "does not exist; name the object's model with --model");
  }
  return sequence;
}

}  // namespace disflow::apps

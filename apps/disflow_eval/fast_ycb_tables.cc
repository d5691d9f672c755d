// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "fast_ycb.h"
#include "units.h"

namespace disflow::apps {
namespace {

// Published figures: Wu, Sutjipto, Wakulicz, Vidal-Calleja, "DisFlow: Scene Flow from Distance
// Field for Object Pose, Velocity Tracking, and Dynamic Object Reconstruction", tables I to IV
// (those of DOPE, ROFT, PoseRBPF and TrackNet are there taken from the ROFT paper).

struct PublishedPose {
  const char* method;
  double add_auc_percent;
  double translation_cm;
  double rotation_deg;
};
using PublishedPoses = std::array<PublishedPose, 5>;
constexpr PublishedPoses kPoses003 = {{{"DOPE", 54.92, 5.1, 28.33},
                                       {"ROFT", 78.50, 2.5, 7.55},
                                       {"PoseRBPF", 68.94, 2.6, 38.46},
                                       {"TrackNet", 63.02, 7.9, 31.73},
                                       {"DisFlow, paper", 92.44, 0.790, 3.519}}};
constexpr PublishedPoses kPoses006 = {{{"DOPE", 57.20, 8.6, 36.13},
                                       {"ROFT", 73.10, 3.1, 13.29},
                                       {"PoseRBPF", 82.92, 2.0, 18.42},
                                       {"TrackNet", 74.83, 11.9, 35.48},
                                       {"DisFlow, paper", 94.83, 0.498, 5.038}}};

struct PublishedVelocity {
  const char* object;
  double roft_cmps, disflow_cmps;
  double roft_degps, disflow_degps;
};
constexpr std::array<PublishedVelocity, 2> kVelocities = {
    {{"003_cracker_box", 5.237, 2.311, 18.250, 7.109},
     {"006_mustard_bottle", 7.227, 1.988, 26.553, 20.343}}};

struct PublishedSurface {
  const char* method;
  double chamfer_m, hausdorff_m, f_1mm, f_2mm;
  double mesh_to_model_deg, model_to_mesh_deg;
};
constexpr std::array<PublishedSurface, 2> kSurfaces006 = {
    {{"TSDF, paper", 0.0059, 0.0106, 0.107, 0.466, 11.96, 14.96},
     {"DisFlow, paper", 0.0045, 0.0069, 0.288, 0.645, 10.44, 10.65}}};

constexpr const char* kMissing = "–";

std::string Show(const char* format, double value) {
  return std::isfinite(value) ? Format(format, value) : kMissing;
}

/// A Markdown table, line by line.
class Table {
 public:
  Table(const std::string& title, const std::vector<std::string>& head)
      : text_("\n**" + title + "**\n\n") {
    Add(head);
    text_ += "|---|";
    for (std::size_t i = 1; i < head.size(); ++i) text_ += "---:|";
    text_ += "\n";
  }
  void Add(const std::vector<std::string>& cells) {
    text_ += "|";
    for (const std::string& cell : cells) text_ += " " + cell + " |";
    text_ += "\n";
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The results of one object, one per mask set; null where there is none.
using ByMask = std::array<const FastYcbResult*, kFastYcbMasks.size()>;

ByMask Find(const std::vector<FastYcbResult>& results, const std::string& object) {
  ByMask found{};
  for (const FastYcbResult& result : results) {
    const auto mask = std::find(kFastYcbMasks.begin(), kFastYcbMasks.end(), result.mask);
    if (result.object == object && mask != kFastYcbMasks.end()) {
      found[static_cast<std::size_t>(mask - kFastYcbMasks.begin())] = &result;
    }
  }
  return found;
}

std::string OurColumn(std::size_t mask) {
  return std::string("**this library**, masks ") + kFastYcbMasks[mask];
}

/// One figure: the published values, then ours for every mask set.
void AddRow(Table& table, const char* name, const char* format,
            const std::vector<double>& published, const ByMask& ours,
            double FastYcbResult::*figure) {
  std::vector<std::string> row = {name};
  for (const double value : published) row.push_back(Show("%g", value));  // as printed there
  for (const FastYcbResult* result : ours) {
    row.push_back(result != nullptr ? Show(format, result->*figure) : kMissing);
  }
  table.Add(row);
}

std::string PoseTable(const char* number, const std::string& object,
                      const PublishedPoses& published, const ByMask& ours) {
  std::vector<std::string> head = {""};
  std::vector<double> auc, translation, rotation;
  for (const PublishedPose& pose : published) {
    head.emplace_back(pose.method);
    auc.push_back(pose.add_auc_percent);
    translation.push_back(pose.translation_cm);
    rotation.push_back(pose.rotation_deg);
  }
  for (std::size_t i = 0; i < ours.size(); ++i) head.push_back(OurColumn(i));
  Table table(std::string("Table ") + number + ": pose, " + object, head);
  AddRow(table, "ADD-AUC %", "%.2f", auc, ours, &FastYcbResult::add_auc_percent);
  AddRow(table, "RMSE e_t cm", "%.3f", translation, ours, &FastYcbResult::translation_cm);
  AddRow(table, "RMSE e_a deg", "%.3f", rotation, ours, &FastYcbResult::rotation_deg);
  return table.text();
}

std::string VelocityTable(const std::vector<FastYcbResult>& results) {
  std::vector<std::string> head = {"", "ROFT", "DisFlow, paper"};
  for (std::size_t i = 0; i < kFastYcbMasks.size(); ++i) head.push_back(OurColumn(i));
  Table table("Table III: velocity", head);
  for (const PublishedVelocity& p : kVelocities) {
    const ByMask ours = Find(results, p.object);
    const std::string name = p.object;
    AddRow(table, (name + ", RMSE e_v cm/s").c_str(), "%.3f", {p.roft_cmps, p.disflow_cmps}, ours,
           &FastYcbResult::linear_cmps);
    AddRow(table, (name + ", RMSE e_ω deg/s").c_str(), "%.3f", {p.roft_degps, p.disflow_degps},
           ours, &FastYcbResult::angular_degps);
  }
  return table.text();
}

std::vector<std::string> SurfaceRow(const std::string& name, const MeshMetrics& m) {
  return {name,
          Show("%.4f", m.chamfer_m),
          Show("%.4f", m.hausdorff_m),
          Show("%.3f", m.f_score[0]),
          Show("%.3f", m.f_score[1]),
          Show("%.2f", kDegrees * m.mesh_to_model_normal_rad) + " / " +
              Show("%.2f", kDegrees * m.model_to_mesh_normal_rad)};
}

std::string SurfaceTable(const ByMask& ours) {
  Table table("Table IV: surface, 006_mustard_bottle",
              {"", "Chamfer m", "Hausdorff m", "F@1mm", "F@2mm", "normals deg"});
  for (const PublishedSurface& p : kSurfaces006) {
    table.Add({p.method, Show("%.4f", p.chamfer_m), Show("%.4f", p.hausdorff_m),
               Show("%.3f", p.f_1mm), Show("%.3f", p.f_2mm),
               Show("%.2f", p.mesh_to_model_deg) + " / " + Show("%.2f", p.model_to_mesh_deg)});
  }
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (ours[i] == nullptr || !ours[i]->surface) continue;
    table.Add(SurfaceRow(OurColumn(i) + ", seen part", ours[i]->surface->seen));
    table.Add(SurfaceRow(OurColumn(i) + ", whole", ours[i]->surface->whole));
  }
  return table.text();
}

std::string AllSequences(const std::vector<FastYcbResult>& results) {
  Table table("All sequences, this library",
              {"sequence, masks", "ADD-AUC %", "e_t cm", "e_a deg", "e_v cm/s", "e_ω deg/s", "ms"});
  for (const FastYcbResult& r : results) {
    table.Add({r.object + ", " + r.mask, Show("%.2f", r.add_auc_percent),
               Show("%.3f", r.translation_cm), Show("%.3f", r.rotation_deg),
               Show("%.3f", r.linear_cmps), Show("%.3f", r.angular_degps),
               Show("%.2f", r.median_ms)});
  }
  return table.text();
}

}  // namespace

std::string FormatFastYcb(const std::vector<FastYcbResult>& results) {
  std::string page =
      "Fast-YCB. Published figures: tables I to IV of the DisFlow paper (Wu, Sutjipto, Wakulicz,\n"
      "Vidal-Calleja). A model-free tracker is aligned with the truth once, at the first frame.\n";
  page += PoseTable("I", kVelocities[0].object, kPoses003, Find(results, kVelocities[0].object));
  page += PoseTable("II", kVelocities[1].object, kPoses006, Find(results, kVelocities[1].object));
  page += VelocityTable(results);
  page += SurfaceTable(Find(results, kVelocities[1].object));
  page += AllSequences(results);
  return page;
}

}  // namespace disflow::apps

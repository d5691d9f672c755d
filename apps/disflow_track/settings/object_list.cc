// SPDX-License-Identifier: BSD-3-Clause
#include "settings/object_list.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>

#include "disflow/hal/mavlink/telemetry.h"
#include "settings/refusal.h"

namespace disflow::apps {
namespace {

constexpr std::size_t kLongestName = 32;
constexpr const char* kKeys = "name, label, index, seed, roi, csv, mesh, mesh_picture, flow";

/// What one table says, not yet compared with the others.
struct Entry {
  std::string where;
  ObjectOptions options;
  std::optional<int> index;
};

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    if (end == text.size()) return parts;
    begin = end + 1;
  }
}

int ParseWhole(const RunSetting& setting, const std::string& text, int min, int max) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc{} && stop == end && value >= min && value <= max) return value;
  Refuse(setting.where, setting.option + " = " + text + ": a whole number from " +
                            std::to_string(min) + " to " + std::to_string(max) + " is needed");
}

/// The pixels of a seed or region: a list in a file, separated by colons where they are typed.
std::vector<int> ParsePixels(const RunSetting& setting, std::size_t count, const char* form) {
  constexpr int kLargest_px = 16384;
  std::vector<std::string> texts = setting.values;
  if (texts.size() == 1) texts = Split(texts[0], ':');
  if (texts.size() != count) Refuse(setting.where, setting.option + ": " + form + " is needed");
  std::vector<int> pixels;
  pixels.reserve(texts.size());
  for (const std::string& text : texts) pixels.push_back(ParseWhole(setting, text, 0, kLargest_px));
  return pixels;
}

const std::string& Single(const RunSetting& setting) {
  if (setting.values.size() != 1 || setting.values[0].empty())
    Refuse(setting.where, setting.option + ": one value is needed");
  return setting.values[0];
}

void CheckName(const std::string& where, const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto may_stand = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (!name.empty() && name.size() <= kLongestName && is_letter(name[0]) &&
      std::all_of(name.begin(), name.end(), may_stand)) {
    return;
  }
  Refuse(where, "'" + name + "' is no name for an object: a letter, then letters, digits and _, " +
                    std::to_string(kLongestName) + " at most, since files and topics bear it");
}

void Apply(const RunSetting& setting, Entry& entry) {
  ObjectOptions& object = entry.options;
  SegmenterConfig& segmenter = object.config.segmenter;
  const std::string& key = setting.option;
  std::map<std::string, std::string*> files = {{"csv", &object.files.csv},
                                               {"mesh", &object.files.mesh},
                                               {"mesh_picture", &object.files.mesh_picture},
                                               {"flow", &object.files.flow}};
  if (key == "name") {
    CheckName(setting.where, Single(setting));
    object.name = Single(setting);
  } else if (key == "label") {
    object.label = static_cast<std::uint8_t>(ParseWhole(setting, Single(setting), 1, 255));
  } else if (key == "index") {
    entry.index = ParseWhole(setting, Single(setting), 0, int{hal::mavlink::kMaxObjectIndex});
  } else if (key == "seed") {
    const std::vector<int> uv = ParsePixels(setting, 2, "a pixel, U:V or [U, V],");
    segmenter.seed_u_px = uv[0];
    segmenter.seed_v_px = uv[1];
  } else if (key == "roi") {
    const std::vector<int> box = ParsePixels(setting, 4, "a region, X:Y:W:H or [X, Y, W, H],");
    segmenter.roi_x_px = box[0];
    segmenter.roi_y_px = box[1];
    segmenter.roi_width_px = box[2];
    segmenter.roi_height_px = box[3];
  } else if (const auto file = files.find(key); file != files.end()) {
    *file->second = Single(setting);
  } else {
    Refuse(setting.where, "an object has no '" + key + "'; known: " + kKeys);
  }
}

Entry ReadEntry(const ObjectTable& table) {
  Entry entry;
  entry.where = table.where;
  entry.options.name.clear();
  entry.options.config = table.config;
  for (const RunSetting& setting : table.keys) Apply(setting, entry);
  if (entry.options.name.empty()) Refuse(table.where, "the object has no name");
  CheckSettings(entry.options.config);
  return entry;
}

/// Whether two objects without masks would start on the same surface.
bool StartAlike(const SegmenterConfig& a, const SegmenterConfig& b) {
  const auto start = [](const SegmenterConfig& c) {
    return std::array{c.seed_u_px, c.seed_v_px,    c.roi_x_px,
                      c.roi_y_px,  c.roi_width_px, c.roi_height_px};
  };
  return start(a) == start(b);
}

void CheckPair(const Entry& first, const Entry& second) {
  const ObjectOptions& a = first.options;
  const ObjectOptions& b = second.options;
  const std::string both = a.name + " and " + b.name;
  if (a.name == b.name) Refuse(second.where, "two objects are called " + a.name);
  if (a.label != 0 && a.label == b.label)
    Refuse(second.where, both + " have the same mask label " + std::to_string(a.label));
  if (a.label == 0 && b.label == 0 && StartAlike(a.config.segmenter, b.config.segmenter)) {
    Refuse(second.where, both +
                             " would be the same object: give each a mask label, or a seed or "
                             "region of its own");
  }
  if (a.index == b.index)
    Refuse(second.where, both + " have the same index " + std::to_string(a.index));
}

/// "run.csv" of the object "box" is "run-box.csv".
std::string NamedAfter(const std::string& file, const std::string& object) {
  if (file.empty()) return file;
  std::filesystem::path path(file);
  if (!path.has_filename()) path = path.parent_path();  // "flow/"
  return path.parent_path() / (path.stem().string() + "-" + object + path.extension().string());
}

/// What the object does not say itself.
void Complete(const CommonObjectOptions& common, std::size_t position, std::size_t count,
              Entry& entry) {
  ObjectOptions& object = entry.options;
  const int index = entry.index.value_or(common.first_index + static_cast<int>(position));
  if (index > int{hal::mavlink::kMaxObjectIndex}) {
    Refuse(entry.where, object.name + " would have index " + std::to_string(index) +
                            " on the links; the last one is " +
                            std::to_string(int{hal::mavlink::kMaxObjectIndex}));
  }
  object.index = static_cast<std::uint8_t>(index);
  object.uses_mask = object.label != 0 || count == 1;
  for (const auto file :
       {&ObjectFiles::csv, &ObjectFiles::mesh, &ObjectFiles::mesh_picture, &ObjectFiles::flow}) {
    if (!(object.files.*file).empty()) continue;
    object.files.*file =
        count == 1 ? common.files.*file : NamedAfter(common.files.*file, object.name);
  }
}

}  // namespace

ObjectTable ParseObject(const std::string& text, const Config& config) {
  const std::string where = "--object " + text + ": ";
  ObjectTable table{.where = where, .keys = {}, .config = config};
  for (const std::string& item : Split(text, ',')) {
    const std::size_t equals = item.find('=');
    if (equals == 0 || equals == std::string::npos) {
      Refuse(where, "'" + item + "' is not key=value; e.g. name=box,label=1; keys: " + kKeys);
    }
    table.keys.push_back({where, item.substr(0, equals), {item.substr(equals + 1)}});
  }
  return table;
}

std::vector<ObjectOptions> MakeObjects(const std::vector<ObjectTable>& tables,
                                       const CommonObjectOptions& common, const Config& config) {
  if (tables.empty()) {
    ObjectOptions object;
    object.index = common.first_index;
    object.config = config;
    object.files = common.files;
    return {object};
  }
  if (tables.size() > kMaxObjects) {
    Refuse(tables[kMaxObjects].where, std::to_string(tables.size()) + " objects are too many; " +
                                          std::to_string(kMaxObjects) + " have room");
  }
  std::vector<Entry> entries;
  for (const ObjectTable& table : tables) {
    Entry entry = ReadEntry(table);
    Complete(common, entries.size(), tables.size(), entry);
    for (const Entry& other : entries) CheckPair(other, entry);
    entries.push_back(std::move(entry));
  }
  std::vector<ObjectOptions> objects;
  objects.reserve(entries.size());
  for (Entry& entry : entries) objects.push_back(std::move(entry.options));
  return objects;
}

}  // namespace disflow::apps

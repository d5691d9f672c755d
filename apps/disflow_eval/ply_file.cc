// SPDX-License-Identifier: BSD-3-Clause
#include "ply_file.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "errors.h"
#include "ply_header.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "binary PLY is read without swapping");

/// Reads one number after the other from the data part of a file, never beyond its end.
class PlyData {
 public:
  PlyData(const fs::path& file, std::string_view data, bool binary)
      : file_(file), data_(data), binary_(binary) {}

  double Next(PlyType type) {
    if (!binary_) return NextText();
    switch (type) {
      case PlyType::kInt8:
        return NextBinary<std::int8_t>();
      case PlyType::kUint8:
        return NextBinary<std::uint8_t>();
      case PlyType::kInt16:
        return NextBinary<std::int16_t>();
      case PlyType::kUint16:
        return NextBinary<std::uint16_t>();
      case PlyType::kInt32:
        return NextBinary<std::int32_t>();
      case PlyType::kUint32:
        return NextBinary<std::uint32_t>();
      case PlyType::kFloat32:
        return static_cast<double>(NextBinary<float>());
      case PlyType::kFloat64:
        return NextBinary<double>();
    }
    return 0.0;
  }

 private:
  [[noreturn]] void Truncated() const {
    throw InputError(file_, "ends before all elements of its header were read");
  }

  template <class T>
  T NextBinary() {
    if (data_.size() < sizeof(T)) Truncated();
    T value;
    std::memcpy(&value, data_.data(), sizeof(T));
    data_.remove_prefix(sizeof(T));
    return value;
  }

  double NextText() {
    const std::size_t start = data_.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) Truncated();
    data_.remove_prefix(start);
    const std::string_view word = data_.substr(0, data_.find_first_of(" \t\r\n"));
    const std::optional<double> value = ParseNumber(word);
    if (!value) {
      throw InputError(file_,
                       "holds '" + std::string(word.substr(0, 40)) + "' where a number is needed");
    }
    data_.remove_prefix(word.size());
    return *value;
  }

  const fs::path& file_;
  std::string_view data_;
  bool binary_;
};

/// Where a named scalar property of an element is, or -1.
int Find(const PlyElement& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.name == name && !property.count_type) return static_cast<int>(i);
  }
  return -1;
}

/// Reads the items of a list property.
void ReadList(const fs::path& file, PlyData& data, const PlyProperty& property,
              std::vector<double>& items) {
  const double count = data.Next(*property.count_type);
  if (!(count >= 0.0) || count != std::floor(count)) {
    throw InputError(file, "a list of '" + property.name + "' has no valid length");
  }
  constexpr double kMostItems = 1000.0;
  if (count > kMostItems) {
    throw InputError(file, "a list of '" + property.name + "' has " + std::to_string(count) +
                               " entries; 1000 can be read");
  }
  items.clear();
  for (double i = 0.0; i < count; ++i) items.push_back(data.Next(property.type));
}

class PlyReader {
 public:
  PlyReader(const fs::path& file, const std::string& text)
      : file_(file),
        header_(ParsePlyHeader(file, text)),
        data_(file, std::string_view(text).substr(header_.size), header_.binary) {}

  Surface Read() {
    for (const PlyElement& element : header_.elements) {
      // Elements without properties take no bytes, so a count would not be bounded by the file.
      if (element.properties.empty()) continue;
      if (element.name == "vertex") {
        ReadVertices(element);
      } else {
        ReadOthers(element);
      }
    }
    if (surface_.vertices.empty()) throw InputError(file_, "holds no vertices");
    CheckIndices();
    return std::move(surface_);
  }

 private:
  void ReadVertices(const PlyElement& element) {
    const int columns[] = {Find(element, "x"),  Find(element, "y"),  Find(element, "z"),
                           Find(element, "nx"), Find(element, "ny"), Find(element, "nz")};
    if (columns[0] < 0 || columns[1] < 0 || columns[2] < 0) {
      throw InputError(file_, "the element 'vertex' lacks x, y or z");
    }
    const int std_column = Find(element, "std_m");
    const bool with_normals = columns[3] >= 0 && columns[4] >= 0 && columns[5] >= 0;
    std::vector<double> values(element.properties.size());
    const auto vector = [&](int first) {
      const auto at = [&](int i) { return values[static_cast<std::size_t>(columns[i])]; };
      return Vec3d(at(first), at(first + 1), at(first + 2));
    };
    for (std::uint64_t i = 0; i < element.count; ++i) {
      ReadValues(element, values);
      const Vec3d position = vector(0);
      if (!position.allFinite()) NotFinite(i);
      surface_.vertices.push_back(position);
      if (std_column >= 0) AddStd(values[static_cast<std::size_t>(std_column)], i);
      if (!with_normals) continue;
      const Vec3d normal = vector(3);
      if (!normal.allFinite()) NotFinite(i);
      surface_.normals.push_back(normal.normalized());
    }
  }

  void AddStd(double std_m, std::uint64_t vertex) {
    // Written so that NaN is refused too.
    if (!(std_m >= 0.0 && std_m < std::numeric_limits<double>::infinity())) {
      throw InputError(
          file_, "vertex " + std::to_string(vertex) + " has a std_m that is no standard deviation");
    }
    surface_.stds_m.push_back(std_m);
  }

  [[noreturn]] void NotFinite(std::uint64_t vertex) const {
    throw InputError(file_, "vertex " + std::to_string(vertex) + " is not finite");
  }

  void ReadValues(const PlyElement& element, std::vector<double>& values) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.count_type) {
        ReadList(file_, data_, property, list_);
      } else {
        values[p] = data_.Next(property.type);
      }
    }
  }

  /// Keeps the corners of faces and skips everything else.
  void ReadOthers(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (!property.count_type) {
          (void)data_.Next(property.type);
          continue;
        }
        ReadList(file_, data_, property, list_);
        if (element.name == "face" &&
            (property.name == "vertex_indices" || property.name == "vertex_index")) {
          AddFace(i);
        }
      }
    }
  }

  void AddFace(std::uint64_t face) {
    for (const double index : list_) {
      if (!(index >= 0.0 && index <= 4294967295.0) || index != std::floor(index)) {
        throw InputError(file_, "face " + std::to_string(face) + " has no valid vertex index");
      }
    }
    for (std::size_t i = 2; i < list_.size(); ++i) {
      surface_.triangles.push_back({static_cast<std::uint32_t>(list_[0]),
                                    static_cast<std::uint32_t>(list_[i - 1]),
                                    static_cast<std::uint32_t>(list_[i])});
    }
  }

  void CheckIndices() const {
    for (const auto& triangle : surface_.triangles) {
      for (const std::uint32_t index : triangle) {
        if (index < surface_.vertices.size()) continue;
        throw InputError(file_, "a face refers to vertex " + std::to_string(index) +
                                    ", the file holds " + std::to_string(surface_.vertices.size()));
      }
    }
  }

  const fs::path& file_;
  PlyHeader header_;
  PlyData data_;
  Surface surface_;
  std::vector<double> list_;
};

}  // namespace

Surface LoadPly(const fs::path& file) {
  const std::string text = ReadFile(file);
  return PlyReader(file, text).Read();
}

}  // namespace disflow::apps

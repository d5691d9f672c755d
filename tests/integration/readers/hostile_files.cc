// SPDX-License-Identifier: BSD-3-Clause
#include "hostile_files.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstring>

namespace disflow::test {
namespace {

constexpr std::size_t kMegabyte = 1'000'000;
constexpr std::int64_t kHole = std::int64_t{20} << 30;

std::string Nothing() { return {}; }
std::string LineWithoutEnd() { return std::string(kMegabyte, '1'); }

/// As many copies as fit into a megabyte.
std::string Repeat(std::string_view begin, std::string_view part, std::string_view end = "") {
  std::string text(begin);
  while (text.size() + part.size() + end.size() <= kMegabyte) text += part;
  return text.append(end);
}

/// Lines with a number each.
std::string Numbered(std::string_view begin, std::string_view end) {
  std::string text;
  for (int i = 0; text.size() < kMegabyte; ++i)
    text.append(begin).append(std::to_string(i)).append(end);
  return text;
}

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
  return bytes;
}

std::string Chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type).append(data);
  const auto crc =
      ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return BigEndian(static_cast<std::uint32_t>(data.size())) + body +
         BigEndian(static_cast<std::uint32_t>(crc));
}

/// The first 33 bytes of a grey image of 16 bits.
std::string PngHeader(std::uint32_t width, std::uint32_t height) {
  return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", BigEndian(width) + BigEndian(height) +
                                                 std::string("\x10\x00\x00\x00\x00", 5));
}

std::string Deflated(std::size_t zeros) {
  const std::string plain(zeros, '\0');
  uLongf size = ::compressBound(static_cast<uLong>(zeros));
  std::string packed(size, '\0');
  (void)::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                    reinterpret_cast<const Bytef*>(plain.data()), static_cast<uLong>(zeros), 9);
  packed.resize(size);
  return packed;
}

std::string PngOf41Bytes() { return PngHeader(8192, 8192) + BigEndian(0x7FFFFFFF) + "IDAT"; }
std::string PngOfWidth() { return PngHeader(0x7FFFFFFF, 1) + Chunk("IDAT", "x"); }
std::string PngOfHeight() { return PngHeader(1, 0x7FFFFFFF) + Chunk("IDAT", "x"); }
std::string PngOfSides() { return PngHeader(999'999, 999'999) + Chunk("IDAT", "x"); }
std::string PngOfPixels() { return PngHeader(8192, 8192) + Chunk("IDAT", Deflated(100)); }
std::string PngWithLongText() {
  return PngHeader(8, 8) + BigEndian(0x7FFFFFFF) + "tEXt" + std::string(1000, 'a');
}
/// Each text unpacks to eight megabytes.
std::string PngWithPackedTexts() {
  const std::string text = Chunk("zTXt", std::string("a\0\0", 3) + Deflated(7'900'000));
  return Repeat(PngHeader(8, 8), text);
}
std::string PngWithManyChunks() { return Repeat(PngHeader(8, 8), Chunk("teXt", "a")); }
std::string PngWithEmptyData() { return Repeat(PngHeader(8, 8), Chunk("IDAT", "")); }

std::string ObjOfOneFace() { return Repeat("v 0 0 0\nv 1 0 0\nv 0 1 0\nf", " 1 2 3", "\n"); }
/// A circle, which has no corner that could be cut off without looking at all others.
std::string ObjOfOneRoundFace() {
  constexpr int kCorners = 30'000;
  constexpr double kTurn_rad = 6.283185307179586;
  std::string text;
  std::string face = "f";
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = kTurn_rad * i / kCorners;
    text += "v " + std::to_string(std::cos(angle_rad)) + " " + std::to_string(std::sin(angle_rad)) +
            " 0\n";
    face += " " + std::to_string(i + 1);
  }
  return text + face + "\n";
}
std::string ObjWithTag() {
  return "v 0 0 0\nt crease 2147483647/2147483647/2147483647 1 1 1\nf 1 1 9\n";
}
std::string ObjWithFarIndex() { return "v 0 0 0\nf 2147483647 2147483646 2147483645\n"; }
std::string ObjOfShapes() { return Repeat("v 0 0 0\n", "o\nf 1 1 9\n"); }
std::string ObjOfMaterials() { return "v 0 0 0\n" + Numbered("usemtl ", "\nf 1 1 9\n"); }
std::string ObjOfVertices() { return Repeat("", "v\n"); }
std::string ObjOfSkinWeights() { return Repeat("", "vw 1 2147483647 1\n"); }

std::string FloatHeader(std::uint64_t width, std::uint64_t height) {
  std::array<std::uint64_t, 2> size{width, height};
  std::string bytes(sizeof(size), '\0');
  std::memcpy(bytes.data(), size.data(), sizeof(size));
  return bytes;
}
std::string FloatOfSides() { return FloatHeader(8192, 8192); }
std::string FloatOfGiantSides() { return FloatHeader(~std::uint64_t{0}, 2); }

std::string DeepJson() { return Repeat("", "["); }
std::string DeepJsonObject() { return Repeat("", "{\"a\":"); }
std::string LongJson() { return Repeat("[", "0,", "0]"); }
std::string CameraOfSides() {
  return R"({"width":8192,"height":8192,"fx":1,"fy":1,"cx":1,"cy":1})";
}
std::string CameraOfGiantSides() {
  return R"({"width":16384,"height":16384,"fx":1,"fy":1,"cx":1,"cy":1})";
}
std::string BopOfOneImage() { return Repeat("{\"0\":{\"cam_K\":[", "1,", "1]}}"); }
std::string BopOfImages() { return Repeat("{", "\"0\":[{}],", "\"0\":{}}"); }
std::string OneField() { return Repeat("", "1 "); }
std::string ManyLines() { return Repeat("", "a\n"); }

std::string TooManyFrames() {
  constexpr int kFrames = 600'000;
  std::string text;
  for (int i = 0; i < kFrames; ++i) text += "0 1\n";
  return text;
}

std::string PlyHeader(std::string_view format, std::string_view elements) {
  return std::string("ply\nformat ")
      .append(format)
      .append(" 1.0\n")
      .append(elements)
      .append("end_header\n");
}
std::string PlyOfVertices() {
  return PlyHeader("ascii",
                   "element vertex 18446744073709551615\nproperty float x\nproperty float y\n"
                   "property float z\n");
}
std::string PlyWithoutProperties() {
  return PlyHeader("ascii", "element vertex 18446744073709551615\n");
}
constexpr const char* kOneVertexAndFaces =
    "element vertex 1\nproperty char x\nproperty char y\nproperty char z\n"
    "element face 1\nproperty list uint char vertex_indices\n";
std::string PlyOfAList() {
  return PlyHeader("binary_little_endian", kOneVertexAndFaces) + std::string(7, '\xFF');
}
std::string PlyOfOneFace() {
  // A list of 999,000 corners, of which most are there.
  const std::string count{'\x58', '\x3E', '\x0F', '\x00'};
  return PlyHeader("binary_little_endian", kOneVertexAndFaces) + std::string(3, '\0') + count +
         std::string(998'000, '\0');
}
std::string PlyOfProperties() {
  return Repeat("ply\nformat ascii 1.0\nelement vertex 1\n", "property char a\n");
}
std::string PlyOfElements() { return Repeat("ply\nformat ascii 1.0\n", "element a 9\n"); }
std::string PlyOfManyElements() {
  std::string text = Repeat("ply\nformat ascii 1.0\n", "element a 9999999999\n");
  return text + "end_header\n";
}

std::string CsvOfColumns() { return Numbered("a", ",") + "\n1\n"; }
std::string CsvOfStages() { return Numbered("a", "_ms,") + "\n1\n"; }
std::string CsvOfEmptyColumns() { return Repeat("", ",", "\n1\n"); }

std::string DeepToml() { return Repeat("a = ", "["); }
std::string DeepTomlTable() { return Repeat("a = ", "{a="); }
std::string TomlOfDots() { return Repeat("a", ".a", " = 1\n"); }
std::string TomlOfDotsInAHead() { return Repeat("[a", ".a", "]\n"); }
std::string TomlOfDottedLines() {
  std::string line = Repeat("a", ".a").substr(0, 2001);
  return line + " = 1\n" + Numbered("[" + line + ".b", "]\n");
}
std::string TomlOfKeys() { return Numbered("k", " = 1\n"); }
std::string TomlOfObjects() { return Repeat("", "[[object]]\n"); }
std::string TomlOfNumbers() { return Repeat("[run]\nseed = [", "1,", "1]\n"); }
std::string TomlOfALongText() { return "sensor = \"" + std::string(kMegabyte, 'a'); }

/// Sixteen million pixels of nothing, as many as an image may have.
std::string PngOfOneValue(std::uint32_t width_px, std::uint32_t height_px) {
  // Before each row stands its filter.
  const std::size_t bytes = (std::size_t{2} * width_px + 1) * height_px;
  return PngHeader(width_px, height_px) + Chunk("IDAT", Deflated(bytes)) + Chunk("IEND", "");
}
std::string LargePng() { return PngOfOneValue(4096, 4096); }
std::string WidePng() { return PngOfOneValue(8192, 2048); }

/// A bumpy sheet: vertices in rows, and two triangles between each four of them.
struct Sheet {
  static constexpr int kColumns = 120;

  static std::string Vertex(int i) {
    return std::to_string(i % kColumns) + " " + std::to_string(i / kColumns) + " " +
           std::to_string(i * 7 % 11);
  }
  /// @param line Of a triangle's three corners, counted from 0.
  template <class Line>
  static void ForEachTriangle(int rows, Line&& line) {
    for (int row = 0; row + 1 < rows; ++row) {
      for (int column = 0; column + 1 < kColumns; ++column) {
        const int corner = row * kColumns + column;
        line(corner, corner + 1, corner + kColumns);
        line(corner + 1, corner + kColumns + 1, corner + kColumns);
      }
    }
  }
};
constexpr int kSheetRows = 170;

std::string LargeObj() {
  std::string text;
  for (int i = 0; i < kSheetRows * Sheet::kColumns; ++i) text += "v " + Sheet::Vertex(i) + "\n";
  Sheet::ForEachTriangle(kSheetRows, [&text](int a, int b, int c) {
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  });
  return text;
}
/// One triangle, as often as fits.
std::string ObjOfOneTriangle() { return Repeat("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "f 1 2 3\n"); }
/// Faces with as many corners as they may have.
std::string ObjOfRoundFaces() {
  constexpr int kCorners = 99;
  constexpr double kTurn_rad = 6.283185307179586;
  std::string start;
  std::string face = "f";
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = kTurn_rad * i / kCorners;
    start += "v " + std::to_string(std::cos(angle_rad)) + " " +
             std::to_string(std::sin(angle_rad)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  return Repeat(start, face + "\n");
}
std::string LargeXyz() { return Repeat("", "0.1 0.2 0.3\n"); }
std::string XyzOfOneCharacterNumbers() { return Repeat("", "1 2 3\n"); }

std::string LargePly() {
  std::string vertices;
  for (int i = 0; i < kSheetRows * Sheet::kColumns; ++i) vertices += Sheet::Vertex(i) + "\n";
  std::string faces;
  int count = 0;
  Sheet::ForEachTriangle(kSheetRows, [&](int a, int b, int c) {
    faces += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    ++count;
  });
  const std::string elements =
      "element vertex " + std::to_string(kSheetRows * Sheet::kColumns) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(count) + "\nproperty list uchar int vertex_indices\n";
  return PlyHeader("ascii", elements) + vertices + faces;
}
/// Three bytes a vertex and seven a face: as many as fit.
std::string PlyOfBytes() {
  constexpr std::size_t kVertices = 150'000;
  constexpr std::size_t kFaces = 120'000;
  const std::string elements = "element vertex " + std::to_string(kVertices) +
                               "\nproperty char x\nproperty char y\nproperty char z\n"
                               "element face " +
                               std::to_string(kFaces) +
                               "\nproperty list uchar char vertex_indices\n";
  std::string faces;
  for (std::size_t i = 0; i < kFaces; ++i) faces += std::string("\3\0\1\2", 4);
  return PlyHeader("binary_little_endian", elements) + std::string(3 * kVertices, '\1') + faces;
}

std::string LargeCsv() {
  std::string text = "frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
  for (int i = 0; text.size() < kMegabyte; ++i)
    text += std::to_string(i) + "," + std::to_string(i) + ",1,1,1,0,0,0,1,1,1,1,1,1,1\n";
  return text;
}
/// Two frames with as many stages as fit.
std::string CsvOfValidStages() {
  std::string head = "frame,timestamp,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";
  std::string row = ",1,1,1,1,0,0,0,1,1,1,1,1,1,1";
  for (int i = 0; head.size() < kMegabyte / 2; ++i) {
    head += "," + std::to_string(i) + "_ms";
    row += ",1";
  }
  return head + "\n0" + row + "\n1" + row + "\n";
}

// Short enough to be read as settings.
std::string YamlOfBrackets() { return std::string(200'000, '['); }
/// Each list holds the one before ten times over.
std::string YamlOfAnchors() {
  std::string text = "a0: &a0 [1]\n";
  for (int i = 1; i < 100; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int copy = 0; copy < 9; ++copy) text += before + " , ";
    text += before + " ]\n";
  }
  return text + "image_width: 8\nimage_height: 8\ncamera_matrix: *a99\n";
}

}  // namespace

const std::vector<HostileFile>& HostileFiles() {
  static const std::vector<HostileFile> files{
      {"PngOf41Bytes", Reader::kPng, "a.png", PngOf41Bytes},
      {"PngOfWidth", Reader::kPng, "a.png", PngOfWidth},
      {"PngOfHeight", Reader::kPng, "a.png", PngOfHeight},
      {"PngOfSides", Reader::kPng, "a.png", PngOfSides},
      {"PngOfPixels", Reader::kPng, "a.png", PngOfPixels},
      {"PngWithLongText", Reader::kPng, "a.png", PngWithLongText},
      {"PngWithPackedTexts", Reader::kPng, "a.png", PngWithPackedTexts},
      {"PngWithManyChunks", Reader::kPng, "a.png", PngWithManyChunks},
      {"PngWithEmptyData", Reader::kPng, "a.png", PngWithEmptyData},
      {"PngOfAHole", Reader::kPng, "a.png", PngOf41Bytes, kHole},
      {"ObjOfOneFace", Reader::kObj, "a.obj", ObjOfOneFace},
      {"ObjOfOneRoundFace", Reader::kObj, "a.obj", ObjOfOneRoundFace},
      {"ObjWithTag", Reader::kObj, "a.obj", ObjWithTag},
      {"ObjWithFarIndex", Reader::kObj, "a.obj", ObjWithFarIndex},
      {"ObjOfShapes", Reader::kObj, "a.obj", ObjOfShapes},
      {"ObjOfMaterials", Reader::kObj, "a.obj", ObjOfMaterials},
      {"ObjOfVertices", Reader::kObj, "a.obj", ObjOfVertices},
      {"ObjOfSkinWeights", Reader::kObj, "a.obj", ObjOfSkinWeights},
      {"ObjOfOneLine", Reader::kObj, "a.obj", LineWithoutEnd},
      {"ObjOfAHole", Reader::kObj, "a.obj", Nothing, kHole},
      {"FloatOfSides", Reader::kFloatDepth, "depth/0.float", FloatOfSides},
      {"FloatOfGiantSides", Reader::kFloatDepth, "depth/0.float", FloatOfGiantSides},
      {"FloatOfAHole", Reader::kFloatDepth, "depth/0.float", FloatOfSides,
       16 + std::int64_t{4} * 8192 * 8192},
      {"CameraOfSides", Reader::kReplay, "cam_K.json", CameraOfSides},
      {"CameraOfBrackets", Reader::kReplay, "cam_K.json", DeepJson},
      {"CameraOfBraces", Reader::kReplay, "cam_K.json", DeepJsonObject},
      {"CameraOfNumbers", Reader::kReplay, "cam_K.json", LongJson},
      {"CameraOfAHole", Reader::kReplay, "cam_K.json", Nothing, kHole},
      {"StampsOfOneLine", Reader::kReplay, "data.txt", LineWithoutEnd},
      {"StampsOfManyFields", Reader::kReplay, "data.txt", OneField},
      {"StampsOfManyLines", Reader::kReplay, "data.txt", ManyLines},
      {"StampsOfTooManyFrames", Reader::kReplay, "data.txt", TooManyFrames},
      {"StampsOfAHole", Reader::kReplay, "data.txt", Nothing, kHole},
      {"ImageListOfOneLine", Reader::kReplay, "depth.txt", LineWithoutEnd},
      {"ImageListOfManyLines", Reader::kReplay, "depth.txt", ManyLines},
      {"ImageListOfAHole", Reader::kReplay, "depth.txt", Nothing, kHole},
      {"SceneOfBrackets", Reader::kReplay, "scene_camera.json", DeepJson},
      {"SceneOfBraces", Reader::kReplay, "scene_camera.json", DeepJsonObject},
      {"SceneOfNumbers", Reader::kReplay, "scene_camera.json", LongJson},
      {"SceneOfOneImage", Reader::kReplay, "scene_camera.json", BopOfOneImage},
      {"SceneOfImages", Reader::kReplay, "scene_camera.json", BopOfImages},
      {"SceneOfAHole", Reader::kReplay, "scene_camera.json", Nothing, kHole},
      {"WorldPosesOfManyFields", Reader::kReplay, "T_wc.txt", OneField},
      {"WorldPosesOfManyLines", Reader::kReplay, "T_wc.txt", ManyLines},
      {"WorldPosesOfAHole", Reader::kReplay, "T_wc.txt", Nothing, kHole},
      {"ModelOfOneFace", Reader::kModel, "a.obj", ObjOfOneFace},
      {"ModelOfOneRoundFace", Reader::kModel, "a.obj", ObjOfOneRoundFace},
      {"ModelWithTag", Reader::kModel, "a.obj", ObjWithTag},
      {"ModelWithFarIndex", Reader::kModel, "a.obj", ObjWithFarIndex},
      {"ModelOfShapes", Reader::kModel, "a.obj", ObjOfShapes},
      {"ModelOfMaterials", Reader::kModel, "a.obj", ObjOfMaterials},
      {"ModelOfSkinWeights", Reader::kModel, "a.obj", ObjOfSkinWeights},
      {"ModelOfAHole", Reader::kModel, "a.obj", Nothing, kHole},
      {"PointsOfOneLine", Reader::kModel, "a.xyz", OneField},
      {"PointsOfManyLines", Reader::kModel, "a.xyz", ManyLines},
      {"PointsOfAHole", Reader::kModel, "a.xyz", Nothing, kHole},
      {"PlyOfVertices", Reader::kPly, "a.ply", PlyOfVertices},
      {"PlyWithoutProperties", Reader::kPly, "a.ply", PlyWithoutProperties},
      {"PlyOfAList", Reader::kPly, "a.ply", PlyOfAList},
      {"PlyOfOneFace", Reader::kPly, "a.ply", PlyOfOneFace},
      {"PlyOfProperties", Reader::kPly, "a.ply", PlyOfProperties},
      {"PlyOfElements", Reader::kPly, "a.ply", PlyOfElements},
      {"PlyOfManyElements", Reader::kPly, "a.ply", PlyOfManyElements},
      {"PlyOfOneLine", Reader::kPly, "a.ply", LineWithoutEnd},
      {"PlyOfAHole", Reader::kPly, "a.ply", PlyOfVertices, kHole},
      {"CsvOfOneLine", Reader::kCsv, "a.csv", LineWithoutEnd},
      {"CsvOfColumns", Reader::kCsv, "a.csv", CsvOfColumns},
      {"CsvOfStages", Reader::kCsv, "a.csv", CsvOfStages},
      {"CsvOfEmptyColumns", Reader::kCsv, "a.csv", CsvOfEmptyColumns},
      {"CsvOfManyLines", Reader::kCsv, "a.csv", ManyLines},
      {"CsvOfAHole", Reader::kCsv, "a.csv", Nothing, kHole},
      {"TruthOfOneLine", Reader::kTruth, "gt/poses.txt", OneField},
      {"TruthOfManyLines", Reader::kTruth, "gt/poses.txt", ManyLines},
      {"TruthStampsOfOneLine", Reader::kTruth, "data.txt", LineWithoutEnd},
      {"TruthStampsOfManyLines", Reader::kTruth, "data.txt", ManyLines},
      {"TruthStampsOfAHole", Reader::kTruth, "data.txt", Nothing, kHole},
      {"TruthOfAHole", Reader::kTruth, "gt/poses.txt", Nothing, kHole},
      {"ImagesOfGiantSides", Reader::kImages, "cam_K.json", CameraOfGiantSides},
      {"ImagesOfBrackets", Reader::kImages, "cam_K.json", DeepJson},
      {"ImagesOfAHole", Reader::kImages, "depth/0.float", FloatOfSides, kHole},
      {"SettingsOfBrackets", Reader::kSettings, "a.toml", DeepToml},
      {"SettingsOfBraces", Reader::kSettings, "a.toml", DeepTomlTable},
      {"SettingsOfDots", Reader::kSettings, "a.toml", TomlOfDots},
      {"SettingsOfDotsInAHead", Reader::kSettings, "a.toml", TomlOfDotsInAHead},
      {"SettingsOfDottedLines", Reader::kSettings, "a.toml", TomlOfDottedLines},
      {"SettingsOfKeys", Reader::kSettings, "a.toml", TomlOfKeys},
      {"SettingsOfALongText", Reader::kSettings, "a.toml", TomlOfALongText},
      {"SettingsOfAHole", Reader::kSettings, "a.toml", Nothing, kHole},
      {"CameraFileOfBrackets", Reader::kCamera, "a.toml", DeepToml},
      {"CameraFileOfDots", Reader::kCamera, "a.toml", TomlOfDots},
      {"CameraFileOfObjects", Reader::kCamera, "a.toml", TomlOfObjects},
      {"CameraFileOfNumbers", Reader::kCamera, "a.toml", TomlOfNumbers},
      {"CameraFileOfAHole", Reader::kCamera, "a.toml", Nothing, kHole},
      {"RosCameraFileOfBrackets", Reader::kCamera, "a.yaml", YamlOfBrackets},
      {"RosCameraFileOfAnchors", Reader::kCamera, "a.yaml", YamlOfAnchors},
      {"RosCameraFileOfOneLine", Reader::kCamera, "a.yaml", LineWithoutEnd},
      {"RosCameraFileOfAHole", Reader::kCamera, "a.yaml", Nothing, kHole},
  };
  return files;
}

const std::vector<HostileFile>& LargeFiles() {
  static const std::vector<HostileFile> files{
      {"Png", Reader::kPng, "a.png", LargePng},
      {"WidePng", Reader::kPng, "a.png", WidePng},
      {"Obj", Reader::kObj, "a.obj", LargeObj},
      {"ObjOfOneTriangle", Reader::kObj, "a.obj", ObjOfOneTriangle},
      {"ObjOfRoundFaces", Reader::kObj, "a.obj", ObjOfRoundFaces},
      {"Model", Reader::kModel, "a.obj", LargeObj},
      {"ModelOfOneTriangle", Reader::kModel, "a.obj", ObjOfOneTriangle},
      {"ModelOfRoundFaces", Reader::kModel, "a.obj", ObjOfRoundFaces},
      {"Points", Reader::kModel, "a.xyz", LargeXyz},
      {"PointsOfShortNumbers", Reader::kModel, "a.xyz", XyzOfOneCharacterNumbers},
      {"Ply", Reader::kPly, "a.ply", LargePly},
      {"PlyOfBytes", Reader::kPly, "a.ply", PlyOfBytes},
      {"Csv", Reader::kCsv, "a.csv", LargeCsv},
      {"CsvOfStages", Reader::kCsv, "a.csv", CsvOfValidStages},
  };
  return files;
}

}  // namespace disflow::test

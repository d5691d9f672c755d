// SPDX-License-Identifier: BSD-3-Clause
#include "ply_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "errors.h"
#include "scratch_dir.h"

namespace disflow::apps {
namespace {

using testing::IsSubstring;

/// Appends the bytes of a number, little endian on the machines that build this.
template <class T>
void Append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

constexpr const char* kBinaryHeader =
    "ply\nformat binary_little_endian 1.0\ncomment made up\nelement vertex 3\n"
    "property float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
    "element face 1\nproperty uchar flag\nproperty list uchar int vertex_indices\nend_header\n";

std::string BinaryTriangle() {
  std::string bytes = kBinaryHeader;
  for (int i = 0; i < 3; ++i) {
    for (const float value :
         {static_cast<float>(i), i == 2 ? 1.0F : 0.0F, 0.5F, 0.0F, 0.0F, 1.0F}) {
      Append(bytes, value);
    }
    Append(bytes, std::uint8_t{200});
  }
  Append(bytes, std::uint8_t{9});
  Append(bytes, std::uint8_t{3});
  for (const std::int32_t index : {0, 1, 2}) Append(bytes, index);
  return bytes;
}

std::string Ascii(const std::string& faces, const std::string& third_vertex = "1 1 0") {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
         "property double z\nelement face 1\nproperty list uchar uint vertex_index\nend_header\n"
         "0 0 0\n1 0 0\n" +
         third_vertex + "\n0 1 0\n" + faces;
}

class PlyFileTest : public testing::Test {
 protected:
  Surface Load(const std::string& text) { return LoadPly(dir_.Write("m.ply", text)); }
  std::string Refusal(const std::string& text) {
    return MessageOf<InputError>([&] { (void)Load(text); });
  }

  ScratchDir dir_;
};

TEST_F(PlyFileTest, BinaryTriangle_IsReadPastUnknownProperties) {
  const Surface s = Load(BinaryTriangle());
  ASSERT_EQ(s.vertices.size(), 3U);
  EXPECT_EQ(s.vertices[2], Vec3d(2, 1, 0.5));
  EXPECT_EQ(s.normals.at(1), Vec3d(0, 0, 1));
  ASSERT_EQ(s.triangles.size(), 1U);
  EXPECT_EQ(s.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST_F(PlyFileTest, StandardDeviations_AreReadAndJudged) {
  const auto point = [](const std::string& std_m) {
    return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
           "property float z\nproperty float std_m\nend_header\n0 0 1 " +
           std_m + "\n";
  };
  EXPECT_EQ(Load(point("0.25")).stds_m, std::vector<double>{0.25});
  EXPECT_TRUE(Load(BinaryTriangle()).stds_m.empty());
  EXPECT_PRED_FORMAT2(IsSubstring, "std_m", Refusal(point("-1")));
}

TEST_F(PlyFileTest, AsciiSquare_BecomesTwoTriangles) {
  const Surface s = Load(Ascii("4 0 1 2 3\n"));
  EXPECT_TRUE(s.normals.empty());
  ASSERT_EQ(s.triangles.size(), 2U);
  EXPECT_EQ(s.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST_F(PlyFileTest, EveryTruncation_IsRefused) {
  const std::string whole = BinaryTriangle();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_PRED_FORMAT2(IsSubstring, "m.ply", Refusal(whole.substr(0, size))) << size;
  }
}

TEST_F(PlyFileTest, IndexOutOfRange_IsRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "refers to vertex 4", Refusal(Ascii("3 0 1 4\n")));
  EXPECT_PRED_FORMAT2(IsSubstring, "no valid vertex index", Refusal(Ascii("3 0 1 -1\n")));
  EXPECT_PRED_FORMAT2(IsSubstring, "no valid vertex index", Refusal(Ascii("3 0 1 0.5\n")));
  EXPECT_PRED_FORMAT2(IsSubstring, "no valid vertex index", Refusal(Ascii("3 0 1 nan\n")));
}

TEST_F(PlyFileTest, FalseCounts_RunIntoTheEndNotOutOfMemory) {
  std::string text = Ascii("3 0 1 2\n");
  text.replace(text.find("vertex 4"), 8, "vertex 18446744073709551615");
  EXPECT_FALSE(Refusal(text).empty());
  EXPECT_FALSE(Refusal(Ascii("4000000000 0 1 2\n")).empty());
  EXPECT_FALSE(Refusal(Ascii("-3 0 1 2\n")).empty());
  EXPECT_FALSE(Refusal(Ascii("inf 0 1 2\n")).empty());
}

TEST_F(PlyFileTest, ElementWithoutProperties_IsSkippedWhateverItsCount) {
  std::string text = Ascii("3 0 1 2\n");
  text.insert(text.find("element face"), "element void 18446744073709551615\n");
  EXPECT_EQ(Load(text).triangles.size(), 1U);
}

TEST_F(PlyFileTest, WordOrNanForACoordinate_IsRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "holds 'x' where a number is needed",
                      Refusal(Ascii("3 0 1 2\n", "x 1 0")));
  EXPECT_PRED_FORMAT2(IsSubstring, "vertex 2 is not finite",
                      Refusal(Ascii("3 0 1 2\n", "nan 1 0")));
}

TEST_F(PlyFileTest, HeaderFaults_AreNamedWithTheirLine) {
  EXPECT_PRED_FORMAT2(IsSubstring, "is no PLY file", Refusal("solid\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "m.ply:2: the format must be",
                      Refusal("ply\nformat binary_big_endian 1.0\nend_header\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "does not say its format", Refusal("ply\nend_header\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "m.ply:3: type 'real' is unknown",
                      Refusal("ply\nelement vertex 1\nproperty real x\nend_header\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "m.ply:2: 'property' does not belong here",
                      Refusal("ply\nproperty float x\nend_header\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "lacks x, y or z",
                      Refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                              "end_header\n1\n"));
}

TEST_F(PlyFileTest, VerticesOfTwoKinds_AreRefused) {
  const std::string plain = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_PRED_FORMAT2(
      IsSubstring, "m.ply:7: the element 'vertex' is there twice",
      Refusal("ply\nformat ascii 1.0\nelement vertex 1\n" + plain + "element vertex 1\n" + plain +
              "property float nx\nproperty float ny\nproperty float nz\nend_header\n"
              "0 0 0\n1 1 1 0 0 1\n"));
}

TEST_F(PlyFileTest, MeshWithoutVertices_IsRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no vertices",
                      Refusal("ply\nformat ascii 1.0\nend_header\n"));
}

}  // namespace
}  // namespace disflow::apps

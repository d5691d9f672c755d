// SPDX-License-Identifier: BSD-3-Clause
#include "model_file.h"

#include <gtest/gtest.h>

#include "errors.h"
#include "scratch_dir.h"

namespace disflow::apps {
namespace {

using testing::IsSubstring;

class ModelFileTest : public testing::Test {
 protected:
  Surface Load(const std::string& name, const std::string& text) {
    return LoadModel(dir_.Write(name, text));
  }
  std::string Refusal(const std::string& name, const std::string& text) {
    return MessageOf<InputError>([&] { (void)Load(name, text); });
  }

  ScratchDir dir_;
};

TEST_F(ModelFileTest, ObjSquare_BecomesTwoTriangles) {
  const Surface s = Load("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(s.triangles.size(), 2U);
  EXPECT_TRUE(s.normals.empty());
  for (const SurfacePoint& point : SampleSurface(s, 100)) {
    EXPECT_TRUE(point.normal.isApprox(Vec3d(0, 0, 1)));
  }
}

TEST_F(ModelFileTest, ObjNormals_AreKeptPerCornerWithUnitLength) {
  const Surface s = Load("m.obj",
                         "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 2\nvn 0 3 0\n"
                         "usemtl x\nf 1//1 2//2 3//1\n");
  ASSERT_EQ(s.normals.size(), 3U);
  EXPECT_EQ(s.normals[0], Vec3d(0, 0, 1));
  EXPECT_EQ(s.normals[1], Vec3d(0, 1, 0));
}

TEST_F(ModelFileTest, ObjWithoutFaces_IsAPointCloud) {
  const Surface s = Load("m.obj", "v 0 0 0\nv 1 0 0.5\n");
  EXPECT_FALSE(s.is_mesh());
  EXPECT_EQ(s.vertices.size(), 2U);
}

TEST_F(ModelFileTest, ObjFaceWithAVertexThatIsNotThere_IsRefused) {
  for (const char* face : {"f 1 2 9\n", "f 0 1 2\n", "f -7 -8 -9\n", "f 1//5 2//5 3//5\n"}) {
    const std::string text = std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\n") + face;
    EXPECT_PRED_FORMAT2(IsSubstring, "m.obj", Refusal("m.obj", text)) << face;
  }
}

TEST_F(ModelFileTest, EmptyObj_IsRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no points", Refusal("m.obj", ""));
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no points", Refusal("m.obj", "\xff\xfe rubbish\n"));
}

TEST_F(ModelFileTest, Xyz_IsReadWithAndWithoutNormals) {
  const Surface plain = Load("m.xyz", "# points\n1 2 3\n4 5 6\n");
  ASSERT_EQ(plain.vertices.size(), 2U);
  EXPECT_EQ(plain.vertices[1], Vec3d(4, 5, 6));
  EXPECT_FALSE(plain.has_normals());
  const Surface full = Load("n.xyz", "1 2 3 0 0 5\n");
  EXPECT_EQ(full.normals.at(0), Vec3d(0, 0, 1));
}

TEST_F(ModelFileTest, XyzLineOfAnotherWidth_IsRefusedWithItsNumber) {
  EXPECT_PRED_FORMAT2(IsSubstring, "m.xyz:2: holds 2 fields", Refusal("m.xyz", "1 2 3\n4 5\n"));
}

TEST_F(ModelFileTest, OtherExtensionOrMissingFile_IsRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, ".obj or .xyz is needed", Refusal("m.stl", "solid\n"));
  EXPECT_PRED_FORMAT2(IsSubstring, "cannot be opened",
                      MessageOf<InputError>([&] { (void)LoadModel(dir_.path() / "none.obj"); }));
}

}  // namespace
}  // namespace disflow::apps

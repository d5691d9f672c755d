// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/obj_file.h"

#include <gtest/gtest.h>

#include <string>

#include "disflow/host/object_meshes.h"
#include "disflow/host/simulated_object.h"
#include "scratch_dir.h"

namespace disflow::host {
namespace {

using apps::ScratchDir;

TEST(ObjFile, WrittenMesh_IsReadBack) {
  const ScratchDir dir;
  const TriangleMesh written = MakeDoughnut();
  const auto file = dir.path() / "model.obj";
  ASSERT_TRUE(WriteObj(file, written).ok());
  TriangleMesh read;
  const hal::Fault fault = ReadObj(file, read);
  ASSERT_TRUE(fault.ok()) << fault.message;
  ASSERT_EQ(read.vertices.size(), written.vertices.size());
  EXPECT_EQ(read.triangles, written.triangles);
  for (std::size_t i = 0; i < read.vertices.size(); ++i) {
    ASSERT_LT((read.vertices[i] - written.vertices[i]).norm(), 1e-7);
  }
}

TEST(ObjFile, PolygonsWithNormals_AreSplitIntoTriangles) {
  const ScratchDir dir;
  const auto file = dir.Write(
      "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
  TriangleMesh mesh;
  ASSERT_TRUE(ReadObj(file, mesh).ok());
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

struct BadObj {
  const char* name;
  const char* text;
  const char* reason;
};

void PrintTo(const BadObj& obj, std::ostream* stream) { *stream << obj.name; }

class MalformedObj : public testing::TestWithParam<BadObj> {};

TEST_P(MalformedObj, IsRefusedByNameAndTheMeshIsKept) {
  const ScratchDir dir;
  const auto file = dir.Write("bad.obj", GetParam().text);
  TriangleMesh mesh = MakeCrackerBox();
  const hal::Fault fault = ReadObj(file, mesh);
  EXPECT_EQ(fault.status, Status::kCorrupt);
  EXPECT_NE(std::string(fault.message).find("bad.obj"), std::string::npos) << fault.message;
  EXPECT_NE(std::string(fault.message).find(GetParam().reason), std::string::npos) << fault.message;
  EXPECT_EQ(mesh.triangles.size(), 12U);
}

INSTANTIATE_TEST_SUITE_P(
    All, MalformedObj,
    testing::Values(BadObj{"Empty", "", "no triangles"},
                    BadObj{"NoObj", "hello\nworld\n", "no triangles"},
                    BadObj{"UnknownVertex", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "vertex 9"},
                    BadObj{"TooLargeNumber", "v 1e999 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "finite"}),
    [](const auto& test) { return test.param.name; });

TEST(ObjFile, MissingFileOrFolder_IsNotFound) {
  const ScratchDir dir;
  TriangleMesh mesh;
  EXPECT_EQ(ReadObj(dir.path() / "none.obj", mesh).status, Status::kNotFound);
  EXPECT_EQ(ReadObj(dir.path(), mesh).status, Status::kNotFound);
}

TEST(SimulatedObject, MeshInMillimetres_IsRefusedWithAHint) {
  const ScratchDir dir;
  SimulationOptions options;
  options.object = ObjectKind::kObjFile;
  options.obj_file =
      dir.Write("mm.obj", "v 0 0 0\nv 100 0 0\nv 0 200 0\nv 0 0 50\nf 1 3 2\nf 1 2 4\n").string();
  TriangleMesh mesh;
  const hal::Fault fault = LoadSimulatedObject(options, mesh);
  EXPECT_EQ(fault.status, Status::kUnsupported);
  EXPECT_NE(std::string(fault.message).find("metres"), std::string::npos) << fault.message;
}

TEST(SimulatedObject, ObjFile_IsMovedToItsCentre) {
  const ScratchDir dir;
  SimulationOptions options;
  options.object = ObjectKind::kObjFile;
  options.obj_file =
      dir.Write("far.obj", "v 5 5 5\nv 5.1 5 5\nv 5 5.2 5\nv 5 5 5.1\nf 1 3 2\nf 1 2 4\n").string();
  TriangleMesh mesh;
  const hal::Fault fault = LoadSimulatedObject(options, mesh);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_LT((mesh.vertices[0] - Vec3d(-0.05, -0.1, -0.05)).norm(), 1e-6);
}

}  // namespace
}  // namespace disflow::host

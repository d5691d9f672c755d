// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/mesh_picture.h"

#include <gtest/gtest.h>

#include "disflow/host/object_meshes.h"

namespace disflow::host {
namespace {

constexpr Rgb kRed{255, 0, 0};

MeshView SmallView() {
  MeshView view;
  view.width_px = 80;
  view.height_px = 60;
  return view;
}

Rgb PixelAt(const std::vector<std::uint8_t>& picture, const MeshView& view, int u, int v) {
  const auto first = static_cast<std::size_t>(3 * (v * view.width_px + u));
  return {picture[first], picture[first + 1], picture[first + 2]};
}

TEST(RenderMesh, Object_FillsThePictureInItsColourOnWhite) {
  const MeshView view = SmallView();
  const TriangleMesh mesh = MakeDoughnut();
  const auto picture = RenderMesh(mesh, std::vector<Rgb>(mesh.vertices.size(), kRed), view);
  ASSERT_EQ(picture.size(), 80U * 60U * 3U);
  int red = 0;
  int white = 0;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      const Rgb color = PixelAt(picture, view, u, v);
      if (color == Rgb{255, 255, 255}) ++white;
      if (color[0] > 50 && color[1] == 0 && color[2] == 0) ++red;
    }
  }
  EXPECT_GT(red, 1300);
  EXPECT_GT(white, 1500);
  EXPECT_EQ(PixelAt(picture, view, 40, 30), (Rgb{255, 255, 255})) << "the hole";
  EXPECT_EQ(PixelAt(picture, view, 40, 30 - 19)[1], 0) << "the ring above it";
}

TEST(RenderMesh, ColoursOfCorners_AreBlended) {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};  // seen from -z, as y points down
  const Rgb blue{0, 0, 255};
  const MeshView view = SmallView();
  const auto picture = RenderMesh(mesh, {kRed, blue, blue, kRed}, view);
  const Rgb left = PixelAt(picture, view, 24, 30);
  const Rgb middle = PixelAt(picture, view, 40, 30);
  const Rgb right = PixelAt(picture, view, 55, 30);
  EXPECT_GT(left[0], right[0] + 80);
  EXPECT_GT(right[2], left[2] + 80);
  EXPECT_NEAR(middle[0], middle[2], 8);
}

TEST(RenderMesh, BackOfASurface_IsGrey) {
  TriangleMesh mesh;
  mesh.vertices = {{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshView view = SmallView();
  const Rgb color = PixelAt(RenderMesh(mesh, std::vector<Rgb>(4, kRed), view), view, 40, 30);
  EXPECT_EQ(color[0], color[1]);
  EXPECT_EQ(color[1], color[2]);
  EXPECT_LT(color[0], 200);
}

TEST(RenderMesh, Elevation_ShowsTheTop) {
  TriangleMesh top;
  top.vertices = {{-0.1, 0.0, -0.1}, {0.1, 0.0, -0.1}, {0.1, 0.0, 0.1}, {-0.1, 0.0, 0.1}};
  top.triangles = {{0, 1, 2}, {0, 2, 3}};  // normal along -y, which is up
  MeshView view = SmallView();
  view.elevation_rad = 0.8;
  EXPECT_EQ(PixelAt(RenderMesh(top, std::vector<Rgb>(4, kRed), view), view, 40, 30)[1], 0);
  view.elevation_rad = -0.8;
  EXPECT_NE(PixelAt(RenderMesh(top, std::vector<Rgb>(4, kRed), view), view, 40, 30)[1], 0);
}

TEST(RenderMesh, EmptyMesh_IsAWhitePicture) {
  const MeshView view = SmallView();
  EXPECT_EQ(RenderMesh({}, {}, view), std::vector<std::uint8_t>(80 * 60 * 3, 255));
}

}  // namespace
}  // namespace disflow::host

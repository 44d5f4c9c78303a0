// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/cut_mesh.h"

#include <vector>

#include <gtest/gtest.h>

#include "crowdface/mesh/normals.h"

#include "support/meshes.h"

namespace crowdface {
namespace {

/// Twice the area of all polygons of a flat mesh.
double area_of(const Topology& topology, const Positions& positions) {
  double sum = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    sum += face_area_vector(topology, f, positions).norm();
  }
  return sum;
}

/// A sheet of quads whose texture coordinates are its positions, and the distances of its vertices
/// from a line across it.
struct Sheet {
  Mesh mesh{testing::grid_topology(6, 5), Positions::Zero(42, 3), {}};
  std::vector<double> above;

  Sheet() {
    for (Index v = 0; v < mesh.positions.rows(); ++v) {
      mesh.positions.row(v) << static_cast<double>(v % 7), static_cast<double>(v / 7), 0;
    }
    mesh.uvs = mesh.positions.leftCols(2);
    mesh.topology.corner_uvs = mesh.topology.corner_vertices;
    for (Index v = 0; v < mesh.positions.rows(); ++v) {
      above.push_back(2.3 - mesh.positions(v, 0) - 0.4 * mesh.positions(v, 1));
    }
  }
};

TEST(CutMesh, KeepsAllOrNothing) {
  Sheet sheet;
  const auto count = sheet.above.size();
  const Mesh whole = cut_mesh(sheet.mesh, std::vector<double>(count, 1.0));
  EXPECT_EQ(whole.topology.corner_vertices, sheet.mesh.topology.corner_vertices);
  EXPECT_EQ(whole.topology.corner_uvs, sheet.mesh.topology.corner_uvs);
  EXPECT_EQ(whole.positions, sheet.mesh.positions);
  EXPECT_EQ(cut_mesh(sheet.mesh, std::vector<double>(count, -1.0)).topology.face_count(), 0);
}

TEST(CutMesh, EndsAtALine) {
  const Sheet sheet;
  const Mesh part = cut_mesh(sheet.mesh, sheet.above);
  EXPECT_EQ(part.positions.topRows(sheet.mesh.positions.rows()), sheet.mesh.positions);
  EXPECT_EQ(part.uvs, part.positions.leftCols(2)) << "texture coordinates stay in place";
  for (const std::uint32_t v : part.topology.corner_vertices) {
    EXPECT_GT(2.3 - part.positions(v, 0) - 0.4 * part.positions(v, 1), -1e-12);
  }
  // The other side is the rest, and both have the same points on the line.
  std::vector<double> below = sheet.above;
  for (double& value : below) value = -value;
  const Mesh rest = cut_mesh(sheet.mesh, below);
  EXPECT_EQ(rest.positions, part.positions);
  EXPECT_NEAR(area_of(part.topology, part.positions) + area_of(rest.topology, rest.positions),
              area_of(sheet.mesh.topology, sheet.mesh.positions), 1e-12);
}

TEST(CutMesh, NeedsNoTextureCoordinates) {
  Sheet sheet;
  sheet.mesh.topology.corner_uvs[0] = kNoIndex;
  const Mesh partly = cut_mesh(sheet.mesh, sheet.above);
  EXPECT_EQ(partly.topology.corner_uvs.size(), partly.topology.corner_vertices.size());
  sheet.mesh.uvs.resize(0, 2);
  const Mesh part = cut_mesh(sheet.mesh, sheet.above);
  EXPECT_TRUE(part.topology.corner_uvs.empty());
  EXPECT_EQ(part.topology.corner_vertices, partly.topology.corner_vertices);
}

}  // namespace
}  // namespace crowdface

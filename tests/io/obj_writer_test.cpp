// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_writer.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::read_text;
using testing::TemporaryFolder;

const char* const kText =
    "# made by hand\r\nmtllib a.mtl\r\no head\nv  0.5\t0 0 1.0 0.2 0.3\r\nv 1 0 0   \nvt 0 0\n"
    "v 1 1 0\ng eyes\nv 0 1 0\ns 2\nusemtl m\nf 1/1 2/1 3/1 4/1\n# the end, without line end";

TEST(WriteObjLike, ChangesNothingButThePositions) {
  const TemporaryFolder folder;
  const ObjFile target = read_obj(folder.write("target.obj", kText));
  Positions positions(4, 3);
  positions << 1, 2, 3, -4.25, 1e-7, 0.1, 7, 8, 9, -0.0, 1e6, 123456.789;
  write_obj_like(target, target.topology, positions, folder / "out.obj");
  EXPECT_EQ(
      read_text(folder / "out.obj"),
      "# made by hand\r\nmtllib a.mtl\r\no head\nv  1\t2 3 1.0 0.2 0.3\r\nv -4.25 1e-07 0.1   \n"
      "vt 0 0\nv 7 8 9\ng eyes\nv 0 1e+06 123456.79\ns 2\nusemtl m\nf 1/1 2/1 3/1 4/1\n"
      "# the end, without line end");
}

TEST(WriteObjLike, GivesShortNumbersBackToTheLetter) {
  const TemporaryFolder folder;
  const std::string text = "v 0.091172 -1.911288 10.635861\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n";
  const ObjFile target = read_obj(folder.write("target.obj", text));
  const Digest digest =
      write_obj_like(target, target.topology, target.positions, folder / "out.obj");
  EXPECT_EQ(read_text(folder / "out.obj"), text);
  EXPECT_EQ(digest, hash_bytes(text));
}

TEST(WriteObjLike, RecomputesNormalsThatFacesUse) {
  const TemporaryFolder folder;
  const ObjFile target = read_obj(folder.write(
      "target.obj", "v 0 0 0\nvn 0 0 1\nv 1 0 0\nvn 0.5 0.25 0.125\nv 0 1 0\nf 1//1 2//1 3//1\n"));
  Positions turned(3, 3);
  turned << 0, 0, 0, 0, 1, 0, 0, 0, 2;  // now in the plane x = 0
  write_obj_like(target, target.topology, turned, folder / "out.obj");
  EXPECT_EQ(read_text(folder / "out.obj"),
            "v 0 0 0\nvn 1 0 0\nv 0 1 0\nvn 0.5 0.25 0.125\nv 0 0 2\nf 1//1 2//1 3//1\n");
}

TEST(WriteObjLike, RefusesWhatIsNotFinite) {
  const TemporaryFolder folder;
  const ObjFile target = read_obj(folder.write("target.obj", kText));
  Positions positions = target.positions;
  positions(2, 1) = std::numeric_limits<double>::quiet_NaN();
  testing::expect_error(ExitCode::kBadData, {"not finite"}, [&] {
    write_obj_like(target, target.topology, positions, folder / "out.obj");
  });
  EXPECT_FALSE(std::filesystem::exists(folder / "out.obj"));
  EXPECT_THROW(write_obj_like(target, target.topology, Positions::Zero(3, 3), folder / "out.obj"),
               BrokenPrecondition);
}

TEST(WriteObj, ReadsBack) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.topology = testing::grid_topology(120, 90);  // several blocks of lines
  mesh.topology.corner_uvs = mesh.topology.corner_vertices;
  mesh.positions = testing::random_positions(mesh.topology.vertex_count, 1);
  mesh.uvs = testing::random_positions(mesh.topology.vertex_count, 2).leftCols<2>();
  encode_obj(mesh, "a test").write(folder / "grid.obj");
  const ObjFile back = read_obj(folder / "grid.obj");
  EXPECT_EQ(first_difference(mesh.topology, back.topology), "");
  EXPECT_EQ(back.positions.cast<float>(), mesh.positions.cast<float>());
  EXPECT_EQ(back.uvs.cast<float>(), mesh.uvs.cast<float>());
}

}  // namespace
}  // namespace crowdface

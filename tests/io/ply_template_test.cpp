// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/ply_template.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/mesh/normals.h"

#include "support/binary_reader.h"
#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

/// A triangle, a quad and a pentagon on nine vertices, one of them in no face.
Topology mixed_topology() {
  return testing::make_topology(9, {{0, 1, 2}, {2, 1, 3, 4}, {4, 3, 5, 6, 7}});
}

TEST(PlyTemplate, ReadsBackWithNormals) {
  const Topology topology = mixed_topology();
  const Positions positions = testing::random_positions(9, 1);
  const Positions normals = vertex_normals(topology, positions);
  const PlyTemplate form(topology);
  testing::BinaryReader file(form.encode(positions, normals, "head").text());
  for (const std::string line :
       {"ply", "format binary_little_endian 1.0", "element vertex 9", "property float x",
        "property float y", "property float z", "property float nx", "property float ny",
        "property float nz", "element face 3", "property list uchar int vertex_indices",
        "end_header"}) {
    EXPECT_EQ(file.next_line(), line + "\n");
  }
  for (Index i = 0; i < 9; ++i) {
    for (Index c = 0; c < 3; ++c) {
      EXPECT_EQ(file.next<float>(), static_cast<float>(positions(i, c)));
    }
    for (Index c = 0; c < 3; ++c) EXPECT_EQ(file.next<float>(), static_cast<float>(normals(i, c)));
  }
  for (Index f = 0; f < 3; ++f) {
    ASSERT_EQ(file.next<std::uint8_t>(), topology.face(f).size());
    for (const std::uint32_t vertex : topology.face(f))
      EXPECT_EQ(file.next<std::uint32_t>(), vertex);
  }
  EXPECT_TRUE(file.at_end());
}

TEST(PlyTemplate, HasTheSameBytesForAnyNumberOfThreads) {
  const Topology grid = testing::grid_topology(300, 200);  // several blocks
  const Positions positions = testing::random_positions(grid.vertex_count, 2);
  const PlyTemplate form(grid);
  std::string first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const EncodedFile file = form.encode(positions, {}, "grid");
    if (first.empty()) first = file.text();
    EXPECT_TRUE(file.text() == first) << threads << " threads";
    EXPECT_EQ(file.digest(), hash_bytes(first));
  }
  const std::size_t faces = 17 * 60000, vertices = 12 * 301 * 201;
  EXPECT_EQ(form.memory_bytes(), faces);
  EXPECT_EQ(form.encoding_memory_bytes(), (12 + 12 + 3) * 301 * 201) << "with normals and colours";
  EXPECT_EQ(first.size(), first.find("end_header\n") + 11 + vertices + faces);
}

TEST(PlyTemplate, HasNoNegativeZero) {
  const PlyTemplate form(testing::make_topology(3, {{0, 1, 2}}));
  const std::string text = form.encode(-1 * Positions::Zero(3, 3), {}, "t").text();
  EXPECT_EQ(text.substr(text.find("end_header\n") + 11, 36), std::string(36, '\0'));
}

TEST(PlyTemplate, RefusesWhatIsNotFinite) {
  const PlyTemplate form(mixed_topology());
  Positions positions = testing::random_positions(9, 1);
  EXPECT_THROW(form.encode(positions.topRows(8), {}, "head_3"), BrokenPrecondition);
  positions(8, 2) = std::numeric_limits<double>::infinity();
  testing::expect_error(ExitCode::kBadData, {"head_3", "not finite"},
                        [&] { form.encode(positions, {}, "head_3"); });
}

TEST(PlyTemplate, WritesPolygonsOfMoreCornersThanAByteCounts) {
  std::vector<std::uint32_t> cap(300);
  std::iota(cap.begin(), cap.end(), 0U);
  const PlyTemplate form(testing::make_topology(300, {cap, {0, 1, 2}}));
  const testing::TemporaryFolder folder;
  folder.write("cap.ply", form.encode(testing::random_positions(300, 1), {}, "cap").text());
  const FileMesh mesh = read_mesh(folder / "cap.ply");
  EXPECT_EQ(mesh.topology.face_offsets, (std::vector<std::uint32_t>{0, 300, 303}));
  EXPECT_EQ(read_ply_positions(folder / "cap.ply").rows(), 300);
}

}  // namespace
}  // namespace crowdface

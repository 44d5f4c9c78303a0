// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/npy.h"

#include <limits>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"

#include "support/binary_reader.h"
#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::BinaryReader;
using testing::TemporaryFolder;

/// Reads the header of a version 1.0 file. \return its dictionary, without the padding.
std::string read_header(BinaryReader& file) {
  EXPECT_EQ(file.next_text(6), "\x93NUMPY");
  EXPECT_EQ(file.next<std::uint8_t>(), 1);
  EXPECT_EQ(file.next<std::uint8_t>(), 0);
  const auto size = file.next<std::uint16_t>();
  const std::string dictionary = file.next_text(size);
  EXPECT_EQ(file.position() % 64, 0U);
  EXPECT_EQ(dictionary.back(), '\n');
  return dictionary.substr(0, dictionary.find('}') + 1);
}

TEST(Npy, ReadsBack) {
  const Positions positions = testing::random_positions(70'000, 1);  // several blocks
  std::string first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const EncodedFile encoded = encode_npy(positions, "head");
    if (first.empty()) first = encoded.text();
    EXPECT_TRUE(encoded.text() == first) << threads << " threads";
  }
  BinaryReader file(first);
  EXPECT_EQ(read_header(file), "{'descr': '<f4', 'fortran_order': False, 'shape': (70000, 3), }");
  for (Index i = 0; i < 3 * positions.rows(); ++i) {
    ASSERT_EQ(file.next<float>(), static_cast<float>(positions.data()[i])) << i;
  }
  EXPECT_TRUE(file.at_end());

  const TemporaryFolder folder;
  EXPECT_EQ(read_npy(folder.write("p.npy", first)), positions.cast<float>().cast<double>().eval());
}

TEST(Npy, RefusesOtherFiles) {
  const TemporaryFolder folder;
  const std::string good = encode_npy(testing::random_positions(5, 1), "p").text();
  const auto refused = [&](const std::string& bytes) {
    testing::expect_error(ExitCode::kBadData, {"p.npy", "expected"},
                          [&] { read_npy(folder.write("p.npy", bytes)); });
  };
  refused("");
  refused(good.substr(0, good.size() - 1));
  refused(good + "x");
  std::string doubles = good;
  doubles[doubles.find("<f4") + 2] = '8';
  refused(doubles);
  Positions positions = Positions::Zero(2, 3);
  positions(0, 0) = std::numeric_limits<double>::quiet_NaN();
  testing::expect_error(ExitCode::kBadData, {"head", "not finite"},
                        [&] { encode_npy(positions, "head"); });
}

TEST(TopologyArrays, SayWhichCornersMakeAFace) {
  Topology topology = testing::make_topology(5, {{0, 1, 2}, {2, 1, 3, 4}});
  topology.corner_uvs = {0, 1, 2, 2, 1, kNoIndex, 3};
  TextureCoordinates uvs(4, 2);
  uvs << 0, 0, 1, 0, 0.5, 0.25, 1, 1;
  const TemporaryFolder folder;
  write_topology_arrays(topology, uvs, {}, folder / "topology");
  const auto read = [&](const std::string& name, const std::string& dictionary) {
    BinaryReader file(testing::read_text(folder / ("topology/" + name)));
    EXPECT_EQ(read_header(file), dictionary) << name;
    return file;
  };
  using Numbers = std::vector<std::int32_t>;
  EXPECT_EQ(read("corners.npy", "{'descr': '<i4', 'fortran_order': False, 'shape': (7,), }")
                .next_array<std::int32_t>(7),
            (Numbers{0, 1, 2, 2, 1, 3, 4}));
  EXPECT_EQ(read("offsets.npy", "{'descr': '<i4', 'fortran_order': False, 'shape': (3,), }")
                .next_array<std::int32_t>(3),
            (Numbers{0, 3, 7}));
  EXPECT_EQ(read("corner_uvs.npy", "{'descr': '<i4', 'fortran_order': False, 'shape': (7,), }")
                .next_array<std::int32_t>(7),
            (Numbers{0, 1, 2, 2, 1, -1, 3}));
  EXPECT_EQ(read("uvs.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (4, 2), }")
                .next_array<float>(8),
            (std::vector<float>{0, 0, 1, 0, 0.5, 0.25, 1, 1}));
}

}  // namespace
}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/row_kernels.h"

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(WriteUnitNormals, EqualsAPlainLoopAtEveryLength) {
  for (const std::size_t count : {0U, 1U, 3U, 15U, 16U, 17U, 100U}) {
    std::vector<float> u(count), v(count);
    for (std::size_t i = 0; i < count; ++i) {
      u[i] = 8 * std::sin(static_cast<float>(7 * i));
      v[i] = std::cos(static_cast<float>(3 * i)) / static_cast<float>(i + 1);
    }
    constexpr std::uint16_t kUntouched = 12345;
    std::vector<std::uint16_t> out(3 * count + 1, kUntouched);
    const auto sums = write_unit_normals({u.data(), v.data()}, count, out.data());
    std::array<std::uint64_t, 3> expected_sums = {};
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f normal = Eigen::Vector3f(u[i], v[i], 1).normalized();
      for (std::size_t c = 0; c < 3; ++c) {
        const float scaled = 65535 * ((normal[static_cast<Eigen::Index>(c)] + 1) / 2) + 0.5F;
        const auto expected = static_cast<std::uint16_t>(scaled);
        EXPECT_EQ(out[3 * i + c], expected) << i << " of " << count;
        expected_sums[c] += expected;
      }
    }
    EXPECT_EQ(sums, expected_sums);
    EXPECT_EQ(out.back(), kUntouched);
  }
}

}  // namespace
}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/hash.h"

#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(Hash, PartsDoNotRunTogether) {
  EXPECT_NE(Hasher().add("ab").add("c").digest(), Hasher().add("a").add("bc").digest());
  EXPECT_NE(Hasher().add(1).add(2).digest(), Hasher().add(2).add(1).digest());
  EXPECT_NE(Hasher().add(0.0).digest(), Hasher().add(-0.0).digest());
}

TEST(Hash, RawPiecesGiveTheDigestOfTheWhole) {
  Hasher pieces;
  pieces.add_raw(std::string_view("Laplacian "));
  pieces.add_raw(std::string_view("face blending"));
  EXPECT_EQ(pieces.digest(), hash_bytes("Laplacian face blending"));
}

TEST(Hash, HexHas32Digits) {
  EXPECT_EQ((Digest{0x0123456789abcdefULL, 0xfULL}).hex(), "0123456789abcdef000000000000000f");
  // The published XXH3-128 value of no bytes: cache entries and reports rest on it.
  EXPECT_EQ(hash_bytes("").hex(), "99aa06d3014798d86001c324468d497f");
}

}  // namespace
}  // namespace crowdface

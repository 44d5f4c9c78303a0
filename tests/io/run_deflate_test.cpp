// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/run_deflate.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

namespace crowdface {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string deflated(const Bytes& bytes, std::size_t piece) {
  std::string stream;
  RunDeflater deflater(stream);
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    deflater.add(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
  }
  deflater.finish();
  return stream;
}

/// Inflates a stream with zlib, which also checks the checksum.
Bytes inflated(const std::string& stream, std::size_t size) {
  Bytes bytes(size + 1);
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &length, reinterpret_cast<const Bytef*>(stream.data()),
                       stream.size()),
            Z_OK);
  bytes.resize(length);
  return bytes;
}

/// The size of the stream that zlib writes with the strategy Z_RLE.
std::size_t size_by_zlib(const Bytes& bytes) {
  z_stream zlib = {};
  EXPECT_EQ(deflateInit2(&zlib, 1, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, Z_RLE), Z_OK);
  Bytes out(deflateBound(&zlib, bytes.size()));
  zlib.next_in = const_cast<Bytef*>(bytes.data());  // NOLINT: zlib only reads
  zlib.avail_in = static_cast<uInt>(bytes.size());
  zlib.next_out = out.data();
  zlib.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&zlib, Z_FINISH), Z_STREAM_END);
  deflateEnd(&zlib);
  return zlib.total_out;
}

/// Random bytes like those of a filtered image: normally distributed around 0, and runs of equal
/// bytes.
Bytes filtered_image(std::size_t size, double deviation, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, deviation);
  Bytes bytes;
  while (bytes.size() < size) {
    bytes.push_back(static_cast<std::uint8_t>(std::lround(noise(random))));
    if (random() % 50 == 0) bytes.insert(bytes.end(), random() % 700, bytes.back());
  }
  bytes.resize(size);
  return bytes;
}

TEST(RunDeflater, ZlibInflatesItsStreams) {
  // Sizes around the ends of blocks, whose runs go on in the next block
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4},
        std::size_t{259}, std::size_t{65'535}, std::size_t{65'536}, std::size_t{65'537},
        std::size_t{65'538}, std::size_t{300'000}}) {
    for (const std::size_t piece : {std::size_t{1000}, std::size_t{1} << 30}) {
      for (const double deviation : {0.0, 0.4, 3.0, 200.0}) {
        const Bytes bytes = filtered_image(size, deviation, static_cast<std::uint32_t>(size));
        ASSERT_EQ(inflated(deflated(bytes, piece), size), bytes)
            << size << " bytes, deviation " << deviation;
      }
    }
  }
}

TEST(RunDeflater, RunsOfEveryLengthAreWritten) {
  Bytes bytes;
  for (std::size_t length = 1; length < 600; ++length) {
    bytes.insert(bytes.end(), length, static_cast<std::uint8_t>(length));
  }
  EXPECT_EQ(inflated(deflated(bytes, bytes.size()), bytes.size()), bytes);
}

// Counts like Fibonacci numbers would give codes of more than 15 bits.
TEST(RunDeflater, CodesAreShortEvenForVeryRareBytes) {
  std::vector<std::size_t> counts = {1, 1};
  while (counts.size() < 22) counts.push_back(counts.end()[-1] + counts.end()[-2]);
  Bytes bytes;
  for (std::size_t s = 0; s < counts.size(); ++s) {
    bytes.insert(bytes.end(), counts[s], static_cast<std::uint8_t>(s));
  }
  std::ranges::shuffle(bytes, std::mt19937(1));
  EXPECT_EQ(inflated(deflated(bytes, bytes.size()), bytes.size()), bytes);
}

TEST(RunDeflater, StreamsAreAsShortAsThoseOfZlib) {
  for (const double deviation : {0.4, 1.0, 3.0, 10.0}) {
    const Bytes bytes = filtered_image(2'000'000, deviation, 7);
    EXPECT_LT(static_cast<double>(deflated(bytes, 3000).size()),
              1.02 * static_cast<double>(size_by_zlib(bytes)))
        << deviation;
  }
}

}  // namespace
}  // namespace crowdface

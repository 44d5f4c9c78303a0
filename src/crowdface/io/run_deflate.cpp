// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/run_deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include <zlib.h>

namespace crowdface {
namespace {

constexpr std::size_t kBlockBytes = 1 << 16;
constexpr std::size_t kMinRun = 3, kMaxRun = 258;
// Symbols of deflate's literal/length code: bytes, the end of a block, classes of run lengths.
constexpr std::size_t kEndOfBlock = 256, kSymbols = 286;
constexpr int kMaxCodeBits = 15, kMaxCodeBitsOfLengths = 7;

/// A class of run lengths: its symbol, and the number of bits after the symbol that select a length
/// of the class.
struct RunClass {
  std::uint16_t symbol;
  std::uint8_t extra_bits;
  std::uint16_t first_length;  ///< length of the shortest run of this class, in bytes
};

/// The class of each run length from kMinRun to kMaxRun (RFC 1951, 3.2.5).
const std::array<RunClass, kMaxRun + 1>& run_classes() {
  static const std::array<RunClass, kMaxRun + 1> classes = [] {
    std::array<RunClass, kMaxRun + 1> all{};
    std::size_t length = kMinRun;
    for (std::uint16_t symbol = 257; symbol < kSymbols; ++symbol) {
      const int extra_bits = symbol < 265 || symbol == 285 ? 0 : (symbol - 261) / 4;
      if (symbol == 285) length = kMaxRun;
      const auto first = static_cast<std::uint16_t>(length);
      for (int i = 0; i < 1 << extra_bits && length <= kMaxRun; ++i, ++length) {
        all[length] = {symbol, static_cast<std::uint8_t>(extra_bits), first};
      }
    }
    return all;
  }();
  return classes;
}

/// Number of bits of each symbol's Huffman code, at most `limit`; 0 for symbols that do not occur.
/// \param counts  how often each symbol occurs; at least two symbols occur
std::vector<int> huffman_lengths(std::vector<std::uint32_t> counts, int limit) {
  const std::size_t symbols = counts.size();
  std::vector<std::size_t> used;
  for (std::size_t s = 0; s < symbols; ++s) {
    if (counts[s] > 0) used.push_back(s);
  }
  for (;;) {
    std::ranges::stable_sort(used, {}, [&](std::size_t s) { return counts[s]; });
    // The weights of the tree's nodes: first the symbols that occur, in ascending order; then the
    // inner nodes, also ascending
    std::vector<std::uint64_t> weights;
    for (const std::size_t s : used) weights.push_back(counts[s]);
    std::vector<std::size_t> parents(2 * used.size() - 1);
    std::size_t next_symbol = 0, next_sum = used.size();
    const auto take_lightest = [&] {
      const bool is_symbol =
          next_symbol < used.size() &&
          (next_sum >= weights.size() || weights[next_symbol] <= weights[next_sum]);
      const std::size_t node = is_symbol ? next_symbol++ : next_sum++;
      parents[node] = weights.size();
      return weights[node];
    };
    while (weights.size() < parents.size()) {
      const std::uint64_t one = take_lightest(), other = take_lightest();
      weights.push_back(one + other);
    }
    std::vector<int> depths(parents.size(), 0);
    for (std::size_t node = parents.size() - 1; node-- > 0;) {
      depths[node] = depths[parents[node]] + 1;
    }
    if (depths.front() <= limit) {
      std::vector<int> lengths(symbols, 0);
      for (std::size_t i = 0; i < used.size(); ++i) lengths[used[i]] = depths[i];
      return lengths;
    }
    for (const std::size_t s : used) counts[s] = counts[s] / 2 + 1;  // makes the tree flatter
  }
}

struct Code {
  std::uint16_t bits = 0;  ///< the code's bits; the lowest bit comes first in the stream
  std::uint8_t length = 0;
};

/// Returns the canonical Huffman code in which the symbols have codes of these lengths, in bits
/// (RFC 1951, 3.2.2).
std::vector<Code> codes_of(const std::vector<int>& lengths) {
  std::vector<Code> codes(lengths.size());
  std::uint32_t next = 0;
  for (int length = 1; length <= kMaxCodeBits; ++length, next <<= 1) {
    for (std::size_t s = 0; s < lengths.size(); ++s) {
      if (lengths[s] != length) continue;
      std::uint16_t reversed = 0;
      for (int bit = 0; bit < length; ++bit) {
        if ((next >> bit & 1U) != 0)
          reversed |= static_cast<std::uint16_t>(1U << (length - 1 - bit));
      }
      codes[s] = {reversed, static_cast<std::uint8_t>(length)};
      ++next;
    }
  }
  return codes;
}

std::uint64_t word_at(const std::uint8_t* bytes) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

/// Finds the first run that begins at index `i` or later. A run begins at an index k if the bytes
/// from k to k + kMinRun - 1 all equal byte k - 1. Returns `size` if there is no run.
std::size_t next_run(const std::uint8_t* bytes, std::size_t i, std::size_t size) {
  for (i = std::max<std::size_t>(i, 1); i + 7 + kMinRun <= size; i += 8) {
    static_assert(kMinRun == 3);
    // Byte k of `differences` is 0 if a run begins at i + k.
    const std::uint64_t one = word_at(bytes + i), two = word_at(bytes + i + 1);
    const std::uint64_t differences =
        (word_at(bytes + i - 1) ^ one) | (one ^ two) | (two ^ word_at(bytes + i + 2));
    // Find the lowest byte of `differences` that is 0 (Warren, Hacker's Delight, 6-1). The lowest
    // bit that is set in `zeros` lies in this byte.
    const std::uint64_t zeros =
        (differences - 0x0101010101010101U) & ~differences & 0x8080808080808080U;
    if (zeros != 0) return i + static_cast<std::size_t>(std::countr_zero(zeros)) / 8;
  }
  for (; i + kMinRun <= size; ++i) {
    if (std::all_of(bytes + i, bytes + i + kMinRun, [&](auto b) { return b == bytes[i - 1]; }))
      return i;
  }
  return size;
}

/// Length of the run of equal bytes that begins at `bytes`, at most `most`. Requires that the first
/// kMinRun bytes are equal.
std::size_t run_length(const std::uint8_t* bytes, std::size_t most) {
  std::size_t length = kMinRun;
  const std::uint64_t repeated = bytes[0] * std::uint64_t{0x0101010101010101};
  for (; length + 8 <= most; length += 8) {
    const std::uint64_t differences = word_at(bytes + length) ^ repeated;
    if (differences != 0)
      return length + static_cast<std::size_t>(std::countr_zero(differences)) / 8;
  }
  while (length < most && bytes[length] == bytes[0]) ++length;
  return length;
}

/// Calls `literals(bytes)` and `run(length)` for the bytes of a block from index `first` on; a run
/// repeats the byte before it.
template <class Literals, class Run>
void visit_tokens(const std::vector<std::uint8_t>& block, std::size_t first,
                  const Literals& literals, const Run& run) {
  const std::uint8_t* const bytes = block.data();
  const std::size_t size = block.size();
  for (std::size_t i = first; i < size;) {
    const std::size_t begin = next_run(bytes, i, size);
    literals(std::span(bytes + i, begin - i));
    if (begin == size) return;
    const std::size_t length = run_length(bytes + begin, std::min(size - begin, kMaxRun));
    run(length);
    i = begin + length;
  }
}

/// Writes bits to memory.
struct BitWriter {
  /// Writes the lowest `count` bits of `bits`.
  /// \param bits   All higher bits must be 0.
  /// \param count  at most 56
  void put(std::uint64_t bits, int count) {
    pending |= bits << pending_count;
    pending_count += static_cast<unsigned>(count);
    std::memcpy(at, &pending, sizeof pending);  // the whole bytes stay, the rest is written again
    at += pending_count / 8;
    pending >>= pending_count / 8 * 8;
    pending_count %= 8;
  }
  char* at;
  std::uint64_t pending;
  unsigned pending_count;
};

/// A symbol of deflate's code for code lengths, and the bits that follow the symbol.
struct LengthToken {
  std::uint8_t symbol, extra, extra_bits;
};

/// Encodes a list of code lengths. One token can stand for a run of up to 138 lengths that are zero
/// (RFC 1951, 3.2.7).
std::vector<LengthToken> length_tokens(const std::vector<int>& lengths) {
  constexpr std::size_t kMinZeros = 3, kMaxFewZeros = 10, kMaxZeros = 138;
  std::vector<LengthToken> tokens;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t zeros = 0;
    while (zeros < kMaxZeros && i + zeros < lengths.size() && lengths[i + zeros] == 0) ++zeros;
    if (zeros > kMaxFewZeros) {
      tokens.push_back({18, static_cast<std::uint8_t>(zeros - kMaxFewZeros - 1), 7});
    } else if (zeros >= kMinZeros) {
      tokens.push_back({17, static_cast<std::uint8_t>(zeros - kMinZeros), 3});
    } else {
      tokens.push_back({static_cast<std::uint8_t>(lengths[i]), 0, 0});
      zeros = 1;
    }
    i += zeros;
  }
  return tokens;
}

}  // namespace

RunDeflater::RunDeflater(std::string& out)
    : out_(out), checksum_(static_cast<std::uint32_t>(adler32(0, nullptr, 0))) {
  out_.append("\x78\x01");  // deflate with a window of 32 KiB, fastest
}

void RunDeflater::add(std::span<const std::uint8_t> bytes) {
  checksum_ = static_cast<std::uint32_t>(adler32_z(checksum_, bytes.data(), bytes.size()));
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), kBlockBytes + written_ - block_.size());
    block_.insert(block_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    bytes = bytes.subspan(count);
    if (block_.size() == kBlockBytes + written_) write_block(false);
  }
}

void RunDeflater::finish() {
  write_block(true);
  if (pending_count_ > 0) out_.push_back(static_cast<char>(pending_));
  for (const int shift : {24, 16, 8, 0}) out_.push_back(static_cast<char>(checksum_ >> shift));
}

void RunDeflater::write_block(bool is_last) {
  const std::array<RunClass, kMaxRun + 1>& classes = run_classes();
  // Count the symbols, and choose their codes
  std::vector<std::uint32_t> counts(kSymbols, 0);
  ++counts[kEndOfBlock];
  // Neighbouring bytes are often equal. If they were counted in the same table, each increment
  // would have to wait for the previous increment of the same counter. Four tables are faster.
  std::array<std::array<std::uint32_t, 256>, 4> byte_counts{};
  visit_tokens(
      block_, written_,
      [&](std::span<const std::uint8_t> bytes) {
        for (std::size_t i = 0; i < bytes.size(); ++i) ++byte_counts[i % 4][bytes[i]];
      },
      [&](std::size_t length) { ++counts[classes[length].symbol]; });
  for (const auto& table : byte_counts) {
    for (std::size_t byte = 0; byte < table.size(); ++byte) counts[byte] += table[byte];
  }
  if (block_.size() == written_) ++counts[0];  // a code needs two symbols
  std::vector<int> lengths = huffman_lengths(std::move(counts), kMaxCodeBits);
  const std::vector<Code> codes = codes_of(lengths);
  while (lengths.back() == 0) lengths.pop_back();
  const std::size_t symbols = lengths.size();
  lengths.push_back(1);  // the code of the distance 1, one bit
  // Reserve memory. No code is longer than 15 bits, so that two bytes per input byte suffice.
  constexpr std::size_t kMaxHeader = 1024;
  packed_.resize(kMaxHeader + 2 * (kBlockBytes + 1));
  BitWriter writer{packed_.data(), pending_, pending_count_};
  const auto put = [&](std::uint64_t bits, int count) { writer.put(bits, count); };
  // Write the block's header: the lengths of the codes
  const std::vector<LengthToken> tokens = length_tokens(lengths);
  std::vector<std::uint32_t> token_counts(19, 0);
  for (const LengthToken& token : tokens) ++token_counts[token.symbol];
  const std::vector<int> token_lengths = huffman_lengths(token_counts, kMaxCodeBitsOfLengths);
  const std::vector<Code> token_codes = codes_of(token_lengths);
  constexpr std::array<std::size_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
  put(is_last ? 1 : 0, 1);
  put(2, 2);  // a block with its own codes
  put(symbols - 257, 5);
  put(0, 5);  // one distance
  put(kOrder.size() - 4, 4);
  for (const std::size_t symbol : kOrder) put(static_cast<std::uint64_t>(token_lengths[symbol]), 3);
  for (const LengthToken& token : tokens) {
    const Code& code = token_codes[token.symbol];
    put(code.bits | std::uint64_t{token.extra} << code.length, code.length + token.extra_bits);
  }
  // Write the codes of the bytes and runs
  visit_tokens(
      block_, written_,
      [&](std::span<const std::uint8_t> bytes) {
        std::size_t i = 0;
        for (; i + 3 <= bytes.size(); i += 3) {  // three codes have at most 45 bits
          const Code &one = codes[bytes[i]], &two = codes[bytes[i + 1]],
                     &three = codes[bytes[i + 2]];
          const int two_end = one.length + two.length;
          put(one.bits | std::uint64_t{two.bits} << one.length |
                  std::uint64_t{three.bits} << two_end,
              two_end + three.length);
        }
        for (; i < bytes.size(); ++i) put(codes[bytes[i]].bits, codes[bytes[i]].length);
      },
      [&](std::size_t length) {
        const RunClass& run = classes[length];
        const Code& code = codes[run.symbol];
        const std::uint64_t extra = length - run.first_length;
        put(code.bits | extra << code.length, code.length + run.extra_bits + 1);
      });
  put(codes[kEndOfBlock].bits, codes[kEndOfBlock].length);
  out_.append(packed_.data(), writer.at);
  pending_ = writer.pending;
  pending_count_ = writer.pending_count;
  if (!block_.empty()) block_ = {block_.back()};
  written_ = block_.size();
}

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/single_text.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

constexpr int kMantissaBits = 23, kExponentBias = 127 + kMantissaBits;

constexpr std::array<std::uint64_t, 11> kPowersOfTen = {
    1,         10,         100,         1'000,         10'000,        100'000,
    1'000'000, 10'000'000, 100'000'000, 1'000'000'000, 10'000'000'000};

/// With how many decimals the gap between neighbours of this binary exponent is at least 1 and less
/// than 10 units of the last one: −⌊log10(2^exponent)⌋.
constexpr int decimals_of(int exponent) {
  constexpr std::int64_t kLog2 = 1'292'913'986;  // log10(2) · 2^32
  return static_cast<int>(-((exponent * kLog2) >> 32));
}

/// In units of 10^−decimals, the decimal number of fewest digits that is nearer to mantissa ·
/// 2^exponent than to any other float, and the nearest of those. All is exact, since it fits into
/// 64 bits for −34 < exponent < −6. The idea is that of Giulietti 2020, *The Schubfach way to
/// render doubles*, §9: of all candidates only the two neighbours are left, once among tens and
/// once among ones. Written without branches, for which of them it is cannot be foreseen.
std::uint64_t shortest_decimal(std::uint32_t mantissa, int exponent, int decimals) {
  const std::uint64_t power = kPowersOfTen[static_cast<std::size_t>(decimals)];
  // All in quarters of the last binary place, times 10^decimals; a 1 is 1 << shift of them.
  const int shift = 2 - exponent;
  const std::uint64_t value = 4 * mantissa * power;
  // Half-way to the neighbours; the lower one is nearer where the binary exponent changes. What
  // lies half-way is read as the even mantissa.
  const std::uint64_t odd = mantissa & 1U;
  const std::uint64_t down = mantissa == 1U << kMantissaBits ? power : 2 * power;
  const std::uint64_t low = value - down + odd, high = value + 2 * power - odd;

  const std::uint64_t ones = value >> shift;
  const std::uint64_t tens = ones / 10 * 10;
  // 0 or 1, so that the choice between them is arithmetic.
  const auto inside = [&](std::uint64_t number) { return (number << shift) >= low ? 1U : 0U; };
  const auto still_inside = [&](std::uint64_t number) {
    return (number << shift) <= high ? 1U : 0U;
  };
  const std::uint64_t tens_inside = inside(tens), more_tens_inside = still_inside(tens + 10);
  const std::uint64_t ones_inside = inside(ones), more_ones_inside = still_inside(ones + 1);
  const std::uint64_t rest = value - (ones << shift) + (ones & 1U);  // a tie goes to the even one
  const std::uint64_t nearer_up = rest > std::uint64_t{1} << (shift - 1) ? 1 : 0;
  const std::uint64_t one_decides = ones_inside ^ more_ones_inside;
  const std::uint64_t up = (one_decides & more_ones_inside) | ((one_decides ^ 1U) & nearer_up);
  const std::uint64_t by_ones = ones + up, by_tens = tens + 10 * more_tens_inside;
  const std::uint64_t take_tens = 0 - (tens_inside ^ more_tens_inside);  // all bits or none
  return by_ones ^ ((by_ones ^ by_tens) & take_tens);
}

/// Eight decimal digits as characters less '0', the first in the lowest byte.
std::uint64_t digits_of(std::uint32_t below_100_000_000) {
  // Halves, quarters, digits: two, four and eight divisions at once, by multiplication.
  std::uint64_t lanes = below_100_000_000 / 10'000;
  lanes |= std::uint64_t{below_100_000_000 % 10'000} << 32;
  std::uint64_t quotients = ((lanes * 10'486) >> 20) & 0x0000'007f'0000'007f;  // by 100
  lanes = quotients | (lanes - 100 * quotients) << 16;
  quotients = ((lanes * 103) >> 10) & 0x000f'000f'000f'000f;  // by 10
  return quotients | (lanes - 10 * quotients) << 8;
}

/// A whole number below 10⁵.
char* write_whole(char* out, std::uint32_t number) {
  constexpr std::uint64_t kZeros = 0x3030'3030'3030'3030;
  if (number < 10) {
    *out = static_cast<char>('0' + number);
    return out + 1;
  }
  const int length = number < 100 ? 2 : number < 1000 ? 3 : number < 10'000 ? 4 : 5;
  const std::uint64_t text = (digits_of(number) | kZeros) >> (8 * (8 - length));
  std::memcpy(out, &text, sizeof text);
  return out + length;
}

/// A number below 10⁵ in units of 10^−10, without zeros at the end of its fraction.
char* write_fixed(char* out, std::uint64_t number) {
  constexpr std::uint64_t kOne = 10'000'000'000, kZeros = 0x3030'3030'3030'3030;
  out = write_whole(out, static_cast<std::uint32_t>(number / kOne));
  const std::uint64_t fraction = number % kOne;
  if (fraction == 0) return out;
  *out++ = '.';
  const std::uint64_t first = digits_of(static_cast<std::uint32_t>(fraction / 100));
  const auto last = static_cast<std::uint32_t>(fraction % 100);
  const std::uint64_t text = first | kZeros;
  std::memcpy(out, &text, sizeof text);
  if (last == 0) return out + (8 - std::countl_zero(first) / 8);
  out[8] = static_cast<char>('0' + last / 10);
  out[9] = static_cast<char>('0' + last % 10);
  return out + (last % 10 == 0 ? 9 : 10);
}

}  // namespace

char* write_single(char* out, double value) {
  const float single = to_single(value);
  // From here to there no exponent is shorter; coordinates seldom lie elsewhere.
  const float size = std::fabs(single);
  if (!(size >= 1e-3F && size < 1e5F)) {
    return std::to_chars(out, out + kLongestSingle, single).ptr;
  }
  *out = '-';
  if (single < 0) ++out;
  const auto bits = std::bit_cast<std::uint32_t>(size);
  const std::uint32_t mantissa = (bits & ((1U << kMantissaBits) - 1)) | (1U << kMantissaBits);
  const int exponent = static_cast<int>(bits >> kMantissaBits) - kExponentBias;
  const int decimals = decimals_of(exponent);
  const std::uint64_t digits = shortest_decimal(mantissa, exponent, decimals);
  return write_fixed(out, digits * kPowersOfTen[static_cast<std::size_t>(10 - decimals)]);
}

}  // namespace crowdface

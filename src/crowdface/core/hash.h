// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace crowdface {

/// A 128-bit XXH3 digest. It detects accidental changes of content but is not cryptographically
/// secure.
struct Digest {
  std::uint64_t high = 0;  ///< the upper 64 bits of the digest
  std::uint64_t low = 0;   ///< the lower 64 bits of the digest
  bool operator==(const Digest&) const = default;
  /// The digest as 32 lower-case hexadecimal digits.
  std::string hex() const;
};

/// Parses the output of `Digest::hex`; nothing if the text is not 32 lower-case hexadecimal digits.
std::optional<Digest> parse_digest(std::string_view hex);

/// Computes the digest of the bytes.
Digest hash_bytes(std::string_view bytes);

/// Computes the digest of a sequence of values.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  /// Hashes the text's length, then the text, so that "ab", "c" and "a", "bc" give different
  /// digests.
  Hasher& add(std::string_view text);
  /// Hashes the bytes without their length. If a text is added in pieces, the digest equals
  /// `hash_bytes` of the whole text.
  Hasher& add_raw(std::string_view bytes);
  Hasher& add(double value);
  Hasher& add(const Digest& digest);
  template <std::integral T>
  Hasher& add(T value) {
    return add_integer(static_cast<std::uint64_t>(value));
  }
  /// Hashes the number of values, then the bytes of the values.
  template <class T>
  Hasher& add_array(std::span<const T> values) {
    add_integer(values.size());
    return add_raw({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  /// Returns the digest of all values added so far.
  Digest digest() const;

 private:
  Hasher& add_integer(std::uint64_t value);
  struct State;
  std::unique_ptr<State> state_;  ///< state of the XXH3 library
};

}  // namespace crowdface

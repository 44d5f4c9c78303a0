// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/hash.h"

#include <bit>
#include <charconv>
#include <new>

#include <xxhash.h>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

static_assert(std::endian::native == std::endian::little, "digests are defined on little-endian");

Digest to_digest(XXH128_hash_t hash) {
  return {hash.high64, hash.low64};
}

}  // namespace

struct Hasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() {
    if (xxh == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(xxh);
  }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

std::string Digest::hex() const {
  return crowdface::hex(high, 16) + crowdface::hex(low, 16);
}

std::optional<Digest> parse_digest(std::string_view hex) {
  constexpr std::size_t kHalf = 16;
  if (hex.size() != 2 * kHalf || hex.find_first_not_of("0123456789abcdef") != hex.npos) {
    return std::nullopt;
  }
  Digest digest;
  std::from_chars(hex.data(), hex.data() + kHalf, digest.high, 16);
  std::from_chars(hex.data() + kHalf, hex.data() + 2 * kHalf, digest.low, 16);
  return digest;
}

Digest hash_bytes(std::string_view bytes) {
  return to_digest(XXH3_128bits(bytes.data(), bytes.size()));
}

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;

Hasher& Hasher::add_raw(std::string_view bytes) {
  if (!bytes.empty()) XXH3_128bits_update(state_->xxh, bytes.data(), bytes.size());
  return *this;
}
Hasher& Hasher::add_integer(std::uint64_t value) {
  return add_raw({reinterpret_cast<const char*>(&value), sizeof value});
}
Hasher& Hasher::add(std::string_view text) {
  return add_integer(text.size()).add_raw(text);
}
Hasher& Hasher::add(double value) {
  return add_integer(std::bit_cast<std::uint64_t>(value));
}
Hasher& Hasher::add(const Digest& digest) {
  return add_integer(digest.high).add_integer(digest.low);
}
Digest Hasher::digest() const {
  return to_digest(XXH3_128bits_digest(state_->xxh));
}

}  // namespace crowdface

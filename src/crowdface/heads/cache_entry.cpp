// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cache_entry.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "crowdface/core/require.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct EntryHeader {
  char magic[8] = {'C', 'F', 'D', 'A', 'T', 'A', '\r', '\n'};
  std::uint32_t version = 1;
  std::uint32_t arrays = 0;
  Digest key;
};
static_assert(sizeof(EntryHeader) == 32);

constexpr std::uint64_t kAlignment = 64;

std::uint64_t aligned(std::uint64_t offset) {
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

Digest key_in_header(const CacheKey& key) {
  return Hasher().add(key.kind).add(key.digest).digest();
}

std::string_view as_bytes(const void* data, std::size_t size) {
  return {static_cast<const char*>(data), size};
}

/// Whether all absolute values are at most 1e9 (kLargest). Compares bit patterns as integers,
/// because compilers can vectorize this loop. The bit patterns of absolute values have the same
/// order as the values; infinity and NaN come last. `differences` becomes negative if a bit pattern
/// exceeds the bit pattern of kLargest.
template <class Integer, class T>
bool all_coordinates(std::span<const T> values) {
  constexpr auto kMagnitude = std::numeric_limits<Integer>::max();
  constexpr auto kLargest = std::bit_cast<Integer>(T{1e9});
  Integer differences = 0;
  for (const T value : values) {
    differences |= kLargest - (std::bit_cast<Integer>(value) & kMagnitude);
  }
  return differences >= 0;
}

}  // namespace

fs::path cache_entry(const fs::path& cache, const CacheKey& key) {
  return cache / concat(key.kind, '-', key.digest.hex(), kCacheExtension);
}

void write_entry(const fs::path& cache, const CacheKey& key,
                 const std::vector<EntryArray>& arrays) {
  constexpr char kPadding[kAlignment] = {};
  EntryHeader header;
  header.arrays = static_cast<std::uint32_t>(arrays.size());
  header.key = key_in_header(key);
  std::vector<CacheEntry::StoredArray> rows;
  std::uint64_t end = sizeof header + arrays.size() * sizeof(CacheEntry::StoredArray);
  std::vector<std::string_view> pieces = {as_bytes(&header, sizeof header), {}};
  for (const EntryArray& array : arrays) {
    const std::uint64_t offset = aligned(end);
    CacheEntry::StoredArray row{{}, array.type, array.columns, array.rows, offset};
    require(array.name.size() < sizeof row.name, "cache: the name of an array is too long");
    std::ranges::copy(array.name, row.name);
    rows.push_back(row);
    pieces.push_back(as_bytes(kPadding, offset - end));
    pieces.push_back(as_bytes(array.data, array.bytes));
    end = offset + array.bytes;
  }
  pieces[1] = as_bytes(rows.data(), rows.size() * sizeof(CacheEntry::StoredArray));
  Hasher hasher;
  for (const std::string_view piece : pieces) hasher.add_raw(piece);
  const Digest checksum = hasher.digest();
  pieces.push_back(as_bytes(&checksum, sizeof checksum));
  make_directories(cache);
  write_file(cache_entry(cache, key), pieces);
}

std::optional<CacheEntry> CacheEntry::open(const fs::path& cache, const CacheKey& key,
                                           const std::optional<Digest>& known_checksum) {
  CacheEntry entry;
  entry.path_ = cache_entry(cache, key);
  if (!path_exists(entry.path_)) return std::nullopt;
  entry.file_ = std::make_shared<const MappedFile>(entry.path_, OnTruncation::kFill);
  const std::string_view bytes = entry.file_->bytes();
  EntryHeader header;
  entry.require_size_fits(bytes.size() >= sizeof header + sizeof(Digest));
  const std::size_t size = bytes.size() - sizeof(Digest);
  entry.checksum_ = known_checksum ? *known_checksum : hash_bytes(bytes.substr(0, size));
  if (bytes.substr(size) != as_bytes(&entry.checksum_, sizeof(Digest))) {
    throw InvalidInput(
        concat(entry.path_.string(), ": cache entry is damaged (its checksum is wrong)"));
  }
  std::memcpy(&header, bytes.data(), sizeof header);
  EntryHeader expected;
  expected.arrays = header.arrays;
  expected.key = key_in_header(key);
  entry.require_match(bytes.starts_with(as_bytes(&expected, sizeof expected)));
  std::uint64_t end = sizeof header + header.arrays * sizeof(StoredArray);
  entry.require_size_fits(end <= size);
  entry.arrays_.resize(header.arrays);
  if (!entry.arrays_.empty()) {  // memcpy must not be given the null pointer of an empty vector
    std::memcpy(entry.arrays_.data(), bytes.data() + sizeof header, end - sizeof header);
  }
  for (const StoredArray& row : entry.arrays_) {
    end = aligned(end);
    entry.require_size_fits(row.offset == end && end <= size && row.name[sizeof row.name - 1] == 0);
    const auto number = static_cast<std::uint64_t>(row.type[1] - '0');
    entry.require_size_fits(number >= 1 && number <= sizeof(double));
    const std::uint64_t in_row = number * row.columns;
    entry.require_size_fits(row.rows <= size / std::max<std::uint64_t>(in_row, 1));
    end += in_row * row.rows;
  }
  entry.require_size_fits(end == size);
  return entry;
}

const CacheEntry::StoredArray& CacheEntry::find_array(std::string_view name,
                                                      const std::array<char, 4>& type) const {
  const auto row =
      std::ranges::find_if(arrays_, [&](const StoredArray& at) { return name == at.name; });
  require_match(row != arrays_.end() && row->type == type);
  return *row;
}

void CacheEntry::require(bool holds) const {
  if (!holds) {
    throw InvalidInput(
        concat(path_.string(), ": cache entry is damaged (it contains numbers out of range)"));
  }
}

void CacheEntry::throw_if_truncated() const {
  if (file_->was_truncated())
    throw InvalidInput(concat(path_.string(), ": cache entry is shorter than when it was opened"));
}

void CacheEntry::require_match(bool matches) const {
  if (!matches) {
    throw InvalidInput(
        concat(path_.string(), ": cache entry is of another version or for other data"));
  }
}

void CacheEntry::require_size_fits(bool fits) const {
  if (!fits) throw InvalidInput(concat(path_.string(), ": cache entry is of the wrong size"));
}

bool are_in_coordinate_range(std::span<const float> values) {
  return all_coordinates<std::int32_t>(values);
}

bool are_in_coordinate_range(std::span<const double> values) {
  return all_coordinates<std::int64_t>(values);
}

bool all_below(std::span<const std::uint32_t> numbers, std::uint64_t end) {
  return std::ranges::all_of(numbers, [&](std::uint32_t number) { return number < end; });
}

bool are_indices(std::span<const std::uint32_t> numbers, std::uint64_t end) {
  return std::ranges::all_of(
      numbers, [&](std::uint32_t number) { return number < end || number == kNoIndex; });
}

}  // namespace crowdface

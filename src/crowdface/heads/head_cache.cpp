// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_cache.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/seen_files.h"
#include "crowdface/smooth/cubic_fit.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The first 128 bytes of an entry, little-endian.
struct Header {
  char magic[8] = {'C', 'F', 'H', 'E', 'A', 'D', '\r', '\n'};
  std::uint32_t version = 3;
  std::uint32_t levels = 0;  ///< how they are represented, see code_of
  std::uint64_t key_high = 0, key_low = 0;
  std::uint64_t vertices = 0;  ///< rows of a field; 0 if rank is 0
  std::uint64_t samples = 0;
  std::uint64_t trajectory_levels = 0;
  std::uint64_t max_level = 0;
  std::uint64_t nodes = 0;  ///< rows of the mixing; 0 unless `levels: basis`
  std::uint64_t rank = 0;   ///< fields
  double error_max = 0, error_rms = 0;
  std::uint64_t error_level = 0;
  std::uint64_t reserved[3] = {};
};
static_assert(sizeof(Header) == 128);

std::uint32_t code_of(Levels levels) {
  switch (levels) {
    case Levels::kExact:
      return 0;
    case Levels::kCubic:
      return 1;
    case Levels::kBasis:
      break;
  }
  return 2;
}

/// Where the parts of an entry begin: header, steps, mixing, trajectory, fields (at a multiple of 64, so
/// that they can be used where they lie).
struct Places {
  explicit Places(const Header& header)
      : mixing(sizeof(Header) + header.rank * sizeof(double)),
        trajectory(mixing + header.nodes * header.rank * sizeof(double)),
        fields((trajectory + 3 * header.samples * header.trajectory_levels * sizeof(float) + 63) /
               64 * 64),
        end(fields + LevelFields::size(header.vertices, header.rank) * sizeof(std::int16_t)) {}
  std::size_t mixing, trajectory, fields, end;
};

/// What the header of an entry of this shape must be, but for what the fit decided.
Header header_of(const Digest& key, const HeadCacheShape& shape) {
  Header header;
  header.levels = code_of(shape.levels);
  header.key_high = key.high;
  header.key_low = key.low;
  if (shape.levels != Levels::kExact) header.vertices = static_cast<std::uint64_t>(shape.vertices);
  header.samples = static_cast<std::uint64_t>(shape.samples);
  header.trajectory_levels = static_cast<std::uint64_t>(shape.trajectory_levels);
  header.max_level = shape.max_level;
  if (shape.levels == Levels::kBasis) header.nodes = static_cast<std::uint64_t>(shape.nodes);
  if (shape.levels == Levels::kCubic) header.rank = CubicFit::kRank;
  return header;
}

}  // namespace

std::optional<PreparedHead> read_cached_head(const fs::path& cache, const Digest& key,
                                             const HeadCacheShape& shape) {
  const fs::path path = cache_entry(cache, key, kPreparedEnding);
  const SeenFile seen(cache, path);
  const auto entry = map_entry(path, seen.digest());
  if (!entry) return std::nullopt;
  const std::string_view bytes = entry->content;
  Header header, expected = header_of(key, shape);
  if (bytes.size() < sizeof header) throw bad_entry(path, "of the wrong size");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (shape.levels == Levels::kBasis) {  // what the fit decided is not known beforehand
    // A field that 16 bits round too coarsely is two.
    expected.rank = std::min(header.rank, 2 * header.nodes);
    expected.error_max = header.error_max;
    expected.error_rms = header.error_rms;
    expected.error_level = header.error_level;
  }
  if (bytes.substr(0, sizeof expected) != bytes_of(&expected, sizeof expected)) {
    throw bad_entry(path, "of another version or for other data");
  }
  const Places places(header);
  if (bytes.size() != places.end) throw bad_entry(path, "of the wrong size");
  PreparedHead head;
  head.max_level = shape.max_level;
  head.trajectory.resize(shape.trajectory_levels, 3 * shape.samples);
  if (head.trajectory.size() > 0) {
    std::memcpy(head.trajectory.data(), bytes.data() + places.trajectory,
                static_cast<std::size_t>(head.trajectory.size()) * sizeof(float));
  }
  StoredLevels& levels = head.levels;
  levels.error = {header.error_max, header.error_rms, header.error_level};
  levels.mixing.resize(static_cast<Index>(header.nodes),
                       header.nodes == 0 ? 0 : static_cast<Index>(header.rank));
  if (levels.mixing.size() > 0) {
    std::memcpy(levels.mixing.data(), bytes.data() + places.mixing,
                static_cast<std::size_t>(levels.mixing.size()) * sizeof(double));
  }
  levels.fields.vertex_count = static_cast<Index>(header.vertices);
  levels.fields.steps.resize(header.rank);
  if (header.rank > 0) {
    std::memcpy(levels.fields.steps.data(), bytes.data() + sizeof header,
                header.rank * sizeof(double));
  }
  // The file is mapped at a page and the fields stand at a multiple of 64.
  levels.fields.numbers = {reinterpret_cast<const std::int16_t*>(bytes.data() + places.fields),
                           LevelFields::size(header.vertices, header.rank)};
  levels.fields.owner = levels.mapped = entry->file;
  // A checksum tells damage from what was written, not what was written from anything else.
  const std::span<const float> trajectory(head.trajectory.data(),
                                          static_cast<std::size_t>(head.trajectory.size()));
  if (!levels.mixing.allFinite() || !are_coordinates(levels.fields.steps) ||
      !are_coordinates(trajectory)) {
    throw bad_entry(path, "damaged (it holds numbers that no head has)");
  }
  if (entry->file->was_cut()) throw bad_entry(path, "being cut");
  seen.remember(entry->sum);
  return head;
}

void write_cached_head(const fs::path& cache, const Digest& key, const HeadCacheShape& shape,
                       const PreparedHead& head) {
  const StoredLevels& levels = head.levels;
  Header header = header_of(key, shape);
  header.rank = levels.fields.steps.size();
  header.error_max = levels.error.max;
  header.error_rms = levels.error.rms;
  header.error_level = levels.error.level;
  const Places places(header);
  const std::string padding(places.fields - places.trajectory -
                                static_cast<std::size_t>(head.trajectory.size()) * sizeof(float),
                            '\0');
  write_entry(cache_entry(cache, key, kPreparedEnding),
              {bytes_of(&header, sizeof header), bytes_of(std::span(levels.fields.steps)),
               bytes_of(levels.mixing.data(),
                        static_cast<std::size_t>(levels.mixing.size()) * sizeof(double)),
               bytes_of(head.trajectory.data(),
                        static_cast<std::size_t>(head.trajectory.size()) * sizeof(float)),
               padding, bytes_of(levels.fields.numbers)});
}

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_cache.h"

#include <algorithm>
#include <cmath>
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
  std::uint32_t version = 4;
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
  std::uint64_t tile_fields = 0;  ///< of all tiles together
  std::uint64_t reserved[2] = {};
};
static_assert(sizeof(Header) == 128);

std::uint32_t code_of(Levels levels) {
  return levels == Levels::kExact ? 0 : levels == Levels::kCubic ? 1 : 2;
}

/// Where the parts of an entry begin: header, mixing, trajectory, first fields of tiles, steps, numbers (at a
/// multiple of 64, so that they can be used where they lie).
struct Places {
  explicit Places(const Header& header)
      : trajectory(sizeof(Header) + header.nodes * header.rank * sizeof(double)),
        first(trajectory + 3 * header.samples * header.trajectory_levels * sizeof(float)),
        steps(first + firsts(header) * sizeof(std::uint32_t)),
        after_steps(steps + header.tile_fields * sizeof(float)),
        numbers((after_steps + 63) / 64 * 64),
        end(numbers + header.tile_fields * kTileValues * sizeof(std::int16_t)) {}
  static std::size_t firsts(const Header& header) {
    return header.vertices == 0 ? 0 : LevelFields::tile_count(header.vertices) + 1;
  }
  std::size_t trajectory, first, steps, after_steps, numbers, end;
};

/// Where it lies: the file is mapped at a page, and all parts stand at multiples of their numbers' size.
template <class T>
std::span<const T> list_at(std::string_view bytes, std::size_t place, std::size_t count) {
  return {reinterpret_cast<const T*>(bytes.data() + place), count};
}

/// Whether each tile has some of the first fields, all of them together what there is, with steps that a value can have.
bool are_fields(const LevelFields& fields) {
  const auto& first = fields.first;
  for (std::size_t t = 0; t + 1 < first.size(); ++t) {
    if (first[t + 1] < first[t] ||
        first[t + 1] - first[t] > static_cast<std::uint32_t>(fields.rank))
      return false;
  }
  const auto is_step = [](float step) {
    int exponent = 0;
    return step == 0 || std::frexp(step, &exponent) == 0.5F;
  };
  return first.empty()
             ? fields.steps.empty()
             : first.front() == 0 && first.back() == fields.steps.size() &&
                   are_coordinates(fields.steps) && std::ranges::all_of(fields.steps, is_step);
}

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

std::optional<PreparedHead> read_cached_head(const CacheFolder& cache, const Digest& key,
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
    expected.rank = std::min(header.rank, header.nodes);
    expected.error_max = header.error_max;
    expected.error_rms = header.error_rms;
    expected.error_level = header.error_level;
  }
  expected.tile_fields =
      std::min(header.tile_fields, header.rank * LevelFields::tile_count(header.vertices));
  if (bytes.substr(0, sizeof expected) != bytes_of(&expected, sizeof expected)) {
    throw bad_entry(path, "of another version or for other data");
  }
  const Places places(header);
  if (bytes.size() != places.end) throw bad_entry(path, "of the wrong size");
  const auto trajectory =
      list_at<float>(bytes, places.trajectory, 3 * header.samples * header.trajectory_levels);
  const auto mixing = list_at<double>(bytes, sizeof header, header.nodes * header.rank);
  PreparedHead head;
  head.trajectory.resize(shape.trajectory_levels, 3 * shape.samples);
  std::ranges::copy(trajectory, head.trajectory.data());
  StoredLevels& levels = head.levels;
  levels.error = {header.error_max, header.error_rms, header.error_level};
  levels.mixing.resize(static_cast<Index>(header.nodes),
                       header.nodes == 0 ? 0 : static_cast<Index>(header.rank));
  std::ranges::copy(mixing, levels.mixing.data());
  LevelFields& fields = levels.fields;
  fields.vertex_count = static_cast<Index>(header.vertices);
  fields.rank = static_cast<Index>(header.rank);
  fields.first = list_at<std::uint32_t>(bytes, places.first, Places::firsts(header));
  fields.steps = list_at<float>(bytes, places.steps, header.tile_fields);
  fields.numbers = list_at<std::int16_t>(bytes, places.numbers, header.tile_fields * kTileValues);
  fields.owner = levels.mapped = entry->file;
  // A checksum tells damage from what was written, not what was written from anything else.
  if (!are_coordinates(mixing) || !are_fields(fields) || !are_coordinates(trajectory)) {
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
  header.rank = static_cast<std::uint64_t>(levels.fields.rank);
  header.error_max = levels.error.max;
  header.error_rms = levels.error.rms;
  header.error_level = levels.error.level;
  header.tile_fields = levels.fields.steps.size();
  const Places places(header);
  const std::string padding(places.numbers - places.after_steps, '\0');
  write_entry(cache_entry(cache, key, kPreparedEnding),
              {bytes_of(&header, sizeof header),
               bytes_of(levels.mixing.data(),
                        static_cast<std::size_t>(levels.mixing.size()) * sizeof(double)),
               bytes_of(head.trajectory.data(),
                        static_cast<std::size_t>(head.trajectory.size()) * sizeof(float)),
               bytes_of(levels.fields.first), bytes_of(levels.fields.steps), padding,
               bytes_of(levels.fields.numbers)});
}

}  // namespace crowdface

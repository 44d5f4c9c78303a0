// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/npy.h"

#include <limits>
#include <span>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

/// A header as NumPy writes it, padded so that the data begins at a multiple of 64 bytes.
/// \param type  element type in Python syntax, such as "'<f4'".
std::string npy_header(std::string_view type, const std::string& shape) {
  std::string dictionary =
      concat("{'descr': ", type, ", 'fortran_order': False, 'shape': (", shape, "), }");
  constexpr std::size_t kPrefix = 10, kAlignment = 64;
  const std::size_t used = kPrefix + dictionary.size() + 1;
  dictionary.append((kAlignment - used % kAlignment) % kAlignment, ' ');
  dictionary += '\n';
  constexpr std::string_view kMagicAndVersion("\x93NUMPY\x01\x00", 8);
  std::string header(kMagicAndVersion);
  append_number(header, static_cast<std::uint16_t>(dictionary.size()));
  header += dictionary;
  return header;
}

std::string positions_header(Index vertices) {
  return npy_header("'<f4'", concat(vertices, ", 3"));
}

void write_indices(const std::vector<std::uint32_t>& indices, const std::filesystem::path& path) {
  constexpr std::size_t kMax = std::numeric_limits<std::int32_t>::max();
  if (indices.size() > kMax) {
    throw InvalidInput(
        concat("points: expected at most ", kMax, " corners, found ", indices.size()));
  }
  EncodedFile file;
  file.add(npy_header("'<i4'", concat(indices.size(), ",")));
  const auto bytes = std::as_bytes(std::span(indices));  // kNoIndex becomes −1
  file.add_without_copy({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  file.write(path);
}

/// Encodes names of up to 64 ASCII characters as a NumPy array of strings.
std::string names_npy(std::span<const std::string> names) {
  constexpr std::size_t kLongest = 64;
  std::string bytes = npy_header("'<U64'", concat(names.size(), ","));
  for (const std::string& name : names) {
    require(name.size() <= kLongest, "names of up to 64 characters");
    for (std::size_t i = 0; i < kLongest; ++i) {
      append_number(bytes, static_cast<std::uint32_t>(i < name.size() ? name[i] : 0));
    }
  }
  return bytes;
}

void write_uvs(const TextureCoordinates& uvs, const std::filesystem::path& path) {
  std::string bytes = npy_header("'<f4'", concat(uvs.rows(), ", 2"));
  for (Index i = 0; i < uvs.rows(); ++i) {
    append_number(bytes, to_single(uvs(i, 0)));
    append_number(bytes, to_single(uvs(i, 1)));
  }
  write_file(path, bytes);
}

}  // namespace

std::size_t npy_encode_bytes(Index vertices) {
  return static_cast<std::size_t>(vertices) * kVectorSize;
}

EncodedFile encode_npy(const Positions& positions, const std::string& what) {
  require_finite(positions, positions.rows(), what);
  EncodedFile file;
  file.add(positions_header(positions.rows()));
  char* data = file.reserve(npy_encode_bytes(positions.rows()));
  parallel_blocks(positions.rows(), kRowsPerBlock, [&](Index begin, Index end) {
    char* out = data + npy_encode_bytes(begin);
    for (Index i = begin; i < end; ++i) out = put_row(out, positions, i);
  });
  file.add_without_copy({data, npy_encode_bytes(positions.rows())});
  return file;
}

EncodedFile encode_npy(std::span<const Displacements> shapes, const std::string& what) {
  constexpr std::size_t kRecord = 2 * sizeof(std::uint32_t) + 3 * sizeof(float);
  std::size_t records = 0;
  for (const Displacements& shape : shapes) {
    require_finite(shape.moves, static_cast<Index>(shape.vertices.size()), what);
    records += shape.vertices.size();
  }
  EncodedFile file;
  file.add(npy_header("[('shape', '<u4'), ('vertex', '<u4'), ('delta', '<f4', (3,))]",
                      concat(records, ",")));
  char* const data = file.reserve(records * kRecord);
  char* out = data;
  for (std::uint32_t s = 0; s < shapes.size(); ++s) {
    for (std::size_t i = 0; i < shapes[s].vertices.size(); ++i) {
      out = put_number(put_number(out, s), shapes[s].vertices[i]);
      out = put_row(out, shapes[s].moves, static_cast<Index>(i));
    }
  }
  file.add_without_copy({data, records * kRecord});
  return file;
}

Positions read_npy(const std::filesystem::path& path) {
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  // Check that crowdface wrote the file. The file size gives the number of rows, and the file must
  // begin with exactly the header that crowdface writes for this number.
  constexpr std::size_t kHeader = 128;
  const auto rows = static_cast<Index>((bytes.size() - std::min(bytes.size(), kHeader)) / 12);
  const std::string header = positions_header(rows);
  if (!bytes.starts_with(header) || bytes.size() != header.size() + npy_encode_bytes(rows)) {
    refuse_file(path,
                "expected positions as crowdface writes them (.npy, float32, n by 3), found "
                "different contents; run crowdface generate to write the file again");
  }
  return read_singles(bytes.data() + header.size(), rows, kVectorSize, path.string());
}

std::vector<std::filesystem::path> write_topology_arrays(const Topology& topology,
                                                         const TextureCoordinates& uvs,
                                                         std::span<const std::string> shapes,
                                                         const std::filesystem::path& folder) {
  make_directories(folder);
  std::vector<std::filesystem::path> files = {folder / kTopologyArrays[0],
                                              folder / kTopologyArrays[1]};
  write_indices(topology.corner_vertices, files[0]);
  write_indices(topology.face_offsets, files[1]);
  if (!shapes.empty()) {
    files.push_back(folder / kTopologyArrays[4]);
    write_file(files.back(), names_npy(shapes));
  }
  if (topology.corner_uvs.empty()) return files;
  files.insert(files.end(), {folder / kTopologyArrays[2], folder / kTopologyArrays[3]});
  write_uvs(uvs, folder / kTopologyArrays[2]);
  write_indices(topology.corner_uvs, folder / kTopologyArrays[3]);
  return files;
}

}  // namespace crowdface

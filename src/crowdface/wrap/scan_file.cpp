// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_file.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr double kFarthest = 1e9;  // as landmarks may be

bool has_area(const Scan& scan) {
  return std::ranges::any_of(scan.triangles, [&](const Triangle& triangle) {
    return length3(area_vector(scan.positions, triangle)) > 0;
  });
}

/// A fan of slivers is a surface to no search: near their vertex they all lie everywhere.
void refuse_fan(const Scan& scan, const std::string& name) {
  constexpr std::uint32_t kManyTriangles = 4096;
  std::vector<std::uint32_t> triangles_at(static_cast<std::size_t>(scan.positions.rows()), 0);
  for (const Triangle& triangle : scan.triangles) {
    for (const std::uint32_t vertex : triangle) ++triangles_at[vertex];
  }
  const auto most = std::max_element(triangles_at.begin(), triangles_at.end());
  if (*most < kManyTriangles || *most < scan.triangles.size() / 2) return;
  const Eigen::Vector3d at = row3(scan.positions, most - triangles_at.begin());
  throw InvalidInput(concat(name, ": expected a scanned surface, found ", *most, " of its ",
                            scan.triangles.size(), " triangles at one vertex, at (", at.x(), ", ",
                            at.y(), ", ", at.z(), ")"));
}

}  // namespace

Scan read_scan(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string()), name = path.string();
  Scan scan;
  if (ending == ".obj") {
    const ObjFile file = read_obj(path);
    scan = {file.positions, triangles_of(file.topology)};
  } else if (ending == ".ply") {
    scan = parse_ply(MappedFile(path).bytes(), name);
  } else if (ending == ".stl") {
    scan = parse_stl(MappedFile(path).bytes(), name);
  } else if (ending == ".glb") {
    scan = parse_glb(MappedFile(path).bytes(), name);
  } else {
    throw InvalidInput(
        concat(name, ": expected a scan whose name ends in .obj, .ply, .stl or .glb"));
  }
  if (scan.triangles.empty()) {
    throw InvalidInput(concat(name, ": expected a surface of triangles, found ",
                              scan.positions.rows(), " points and no face"));
  }
  if (!(scan.positions.array().abs() <= kFarthest).all()) {
    throw InvalidInput(concat(name, ": expected finite positions, none farther than ", kFarthest,
                              " from the origin, found another"));
  }
  if (!has_area(scan)) {
    throw InvalidInput(concat(name, ": expected a surface, found triangles without area"));
  }
  weld(scan);
  refuse_fan(scan, name);
  return without_shells(scan);
}

std::string encode_scan(const Scan& scan) {
  std::string bytes =
      concat("ply\nformat binary_little_endian 1.0\nelement vertex ", scan.positions.rows(),
             "\nproperty float x\nproperty float y\nproperty float z\nelement face ",
             scan.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
  const std::size_t header = bytes.size();
  const auto points = static_cast<std::size_t>(scan.positions.size());
  bytes.resize(header + 4 * points + 13 * scan.triangles.size());
  char* out = bytes.data() + header;
  for (std::size_t i = 0; i < points; ++i, out += 4) {
    const auto value = static_cast<float>(scan.positions.data()[i]);
    std::memcpy(out, &value, 4);
  }
  for (const Triangle& t : scan.triangles) {
    *out++ = 3;
    std::memcpy(out, t.data(), 12);
    out += 12;
  }
  return bytes;
}

}  // namespace crowdface

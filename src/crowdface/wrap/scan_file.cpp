// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_file.h"

#include <algorithm>
#include <bit>

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
void refuse_fan(const Scan& scan, const std::filesystem::path& path) {
  constexpr std::uint32_t kManyTriangles = 4096;
  std::vector<std::uint32_t> triangles_at(static_cast<std::size_t>(scan.positions.rows()), 0);
  for (const Triangle& triangle : scan.triangles) {
    for (const std::uint32_t vertex : triangle) ++triangles_at[vertex];
  }
  const auto most = std::max_element(triangles_at.begin(), triangles_at.end());
  if (*most < kManyTriangles || *most < scan.triangles.size() / 2) return;
  const Eigen::Vector3d at = row3(scan.positions, most - triangles_at.begin());
  refuse_file(path,
              concat("expected a scanned surface, found ", *most, " of its ", scan.triangles.size(),
                     " triangles at one vertex, at (", at.x(), ", ", at.y(), ", ", at.z(), ")"));
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
    refuse_file(path, "expected a scan whose name ends in .obj, .ply, .stl or .glb");
  }
  if (scan.triangles.empty()) {
    refuse_file(path, concat("expected a surface of triangles, found ", scan.positions.rows(),
                             " points and no face"));
  }
  if (!(scan.positions.array().abs() <= kFarthest).all()) {
    refuse_file(path, concat("expected finite positions, none farther than ", kFarthest,
                             " from the origin, found another"));
  }
  if (!has_area(scan)) refuse_file(path, "expected a surface, found triangles without area");
  weld(scan);
  refuse_fan(scan, path);
  return without_shells(scan);
}

}  // namespace crowdface

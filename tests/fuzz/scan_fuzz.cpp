// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/wrap/scan_file.h"

#include "fuzz/input_file.h"

namespace {

// A scan's format is told by its name; here by how it begins.
crowdface::Scan parse(std::string_view bytes) {
  if (bytes.starts_with("ply")) return crowdface::parse_ply(bytes, "scan.ply");
  if (bytes.starts_with("glTF")) return crowdface::parse_glb(bytes, "scan.glb");
  return crowdface::parse_stl(bytes, "scan.stl");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    crowdface::Scan scan = parse(crowdface::fuzz::text_of(data, size));
    for (const crowdface::Triangle& triangle : scan.triangles) {
      for (const std::uint32_t vertex : triangle) {
        if (static_cast<crowdface::Index>(vertex) >= scan.positions.rows()) std::abort();
      }
    }
    if (scan.positions.allFinite()) crowdface::weld(scan);
  } catch (const crowdface::Error&) {
  }
  return 0;
}

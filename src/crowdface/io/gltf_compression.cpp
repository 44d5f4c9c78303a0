// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/gltf_compression.h"

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include "crowdface/core/input_limits.h"

namespace crowdface {

std::optional<std::string> decode_meshopt(std::string_view bytes, const MeshoptView& view) {
  constexpr std::size_t kMaxStride = 256;
  // Upper bound of the decoded size: kMaxRatio (the codec's largest compression ratio) times the
  // size of the data, plus kTailBytes for the end of the data.
  constexpr std::size_t kMaxRatio = 256, kTailBytes = 4096;
  const bool attributes = view.mode == "ATTRIBUTES";
  const bool sound = view.stride > 0 && view.stride <= kMaxStride && view.count > 0 &&
                     view.count <= (kMaxRatio * bytes.size() + kTailBytes) / view.stride &&
                     (attributes ? view.stride % 4 == 0 : view.stride == 2 || view.stride == 4);
  if (!sound || (view.mode == "TRIANGLES" && view.count % 3 != 0)) return std::nullopt;
  std::string out(view.count * view.stride, '\0');
  const auto* in = reinterpret_cast<const unsigned char*>(bytes.data());
  int failed = -1;
  if (attributes) {
    failed = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, in, bytes.size());
  } else if (view.mode == "TRIANGLES") {
    failed = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, in, bytes.size());
  } else if (view.mode == "INDICES") {
    failed = meshopt_decodeIndexSequence(out.data(), view.count, view.stride, in, bytes.size());
  }
  if (failed != 0) return std::nullopt;
  if (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) {
    meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  } else if (view.filter == "QUATERNION" && view.stride == 8) {
    meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  } else if (!view.filter.empty() && view.filter != "NONE") {
    return std::nullopt;
  }
  return out;
}

std::optional<DracoMesh> decode_draco(std::string_view bytes,
                                      const std::vector<DracoAttribute>& attributes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return std::nullopt;
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  DracoMesh result;
  result.point_count = mesh->num_points();
  if (result.point_count > input_limits().vertices || mesh->num_faces() > input_limits().faces) {
    return std::nullopt;
  }
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh->face(f)) {
      if (corner.value() >= result.point_count) return std::nullopt;
      result.corners.push_back(corner.value());
    }
  }
  for (const auto& [id, width] : attributes) {
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
    if (attribute == nullptr) return std::nullopt;
    std::vector<double>& rows = result.attributes.emplace_back();
    rows.reserve(result.point_count * width);
    std::vector<float> row(width);
    for (draco::PointIndex p(0); p < mesh->num_points(); ++p) {
      const draco::AttributeValueIndex value = attribute->mapped_index(p);
      if (value.value() >= attribute->size() ||
          !attribute->ConvertValue<float>(value, static_cast<std::int8_t>(width), row.data())) {
        return std::nullopt;
      }
      rows.insert(rows.end(), row.begin(), row.end());
    }
  }
  return result;
}

}  // namespace crowdface

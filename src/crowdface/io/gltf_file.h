// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "crowdface/io/shallow_json.h"

namespace crowdface {

/// The joints and weights of the vertices of a skinned mesh. Element n of both lists comes from the
/// attributes JOINTS_n and WEIGHTS_n; it has four numbers for each vertex.
struct GltfSkinWeights {
  std::vector<std::vector<std::uint32_t>> joints;  ///< indices into the skin's list of joints
  std::vector<std::vector<double>> weights;        ///< weights of these joints
};

/// A glTF 2.0 scene and its buffers. Error messages name the file.
class GltfFile {
 public:
  using Json = nlohmann::ordered_json;

  /// \param bytes  a GLB file or JSON text; must outlive this object.
  /// \param path  path of the file; the object searches for external buffers beside this file.
  /// \throws InvalidInput
  GltfFile(std::string_view bytes, std::filesystem::path path);

  /// The whole JSON of the glTF file.
  const Json& scene() const { return scene_; }
  /// Throws InvalidInput with the name of the file and `what`.
  [[noreturn]] void fail(const std::string& what) const;

  /// The values of an accessor in row-major order. Normalized integers become the fractions that
  /// they encode. Sparse values replace the values of the base array.
  /// \param accessor  index of the accessor.
  /// \param width     numbers per element: 3 for "VEC3".
  /// \throws InvalidInput if a value is not finite.
  std::vector<double> read_values(std::size_t accessor, std::size_t width);
  /// The values of an accessor as unsigned integers. The parameters are those of read_values.
  std::vector<std::uint32_t> read_unsigned_values(std::size_t accessor, std::size_t width);
  /// The data of a URI: embedded in the URI, or read from a file beside the glTF file.
  /// \param what  name of the data in messages, such as "its buffer 2"
  std::string read_uri(const std::string& uri, const std::string& what) const;
  /// The uncompressed content of the buffer view with the index `number`.
  std::string_view view(std::size_t number);

  /// The parent of each node, or kNoIndex.
  std::vector<std::uint32_t> parents() const;
  /// For each node, the transform from the node's axes to the file's axes.
  /// \param parents  result of `parents`.
  std::vector<Eigen::Matrix4d> world_transforms(const std::vector<std::uint32_t>& parents) const;
  /// For each joint of a skin, the transform from the mesh's axes to the file's axes in the rest
  /// pose.
  /// \param worlds  result of `world_transforms`.
  std::vector<Eigen::Matrix4d> joint_transforms(std::size_t skin,
                                                const std::vector<Eigen::Matrix4d>& worlds);
  /// Reads the joints and weights of a primitive.
  /// \param attributes  the attributes of a primitive with `count` vertices.
  GltfSkinWeights read_skin_weights(const Json& attributes, std::size_t count);

 private:
  /// The content of the buffer with the index `number`.
  std::string_view buffer(std::size_t number);
  /// Reads `count` rows of `width` numbers.
  /// \param view_index  the buffer view that contains the rows
  /// \param byte_offset  start of the first row in the view
  /// \param type  component type of the numbers as a glTF code, such as gltf::kFloat
  /// \param accessor  index of the accessor, for messages
  std::vector<double> read_rows(std::size_t view_index, std::size_t byte_offset, int type,
                                std::size_t count, std::size_t width, std::size_t accessor);
  /// Subtracts `more` from `remaining_numbers_`; throws InvalidInput if fewer numbers remain.
  void reserve_numbers(std::size_t more);

  std::filesystem::path path_;
  Json scene_;               ///< the JSON of the file
  std::string_view binary_;  ///< the binary chunk of a GLB file; empty for JSON text
  /// contents of the buffers that have a URI and of the compressed buffer views, by index
  std::map<std::size_t, std::string> decoded_buffers_, decoded_views_;
  /// how many more numbers may be read from this file, so that a small hostile file cannot exhaust
  /// memory
  std::size_t remaining_numbers_ = 0;
};

/// A matrix from 16 numbers in column-major order.
Eigen::Matrix4d matrix_from(const std::vector<double>& columns);
/// The product of two matrices, with a fixed order of operations. Eigen's order depends on the
/// machine, which changes the last bits.
Eigen::Matrix4d matrix_product(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b);
/// A point (three numbers) transformed by a matrix, with a fixed order of operations.
Eigen::Vector3d transform_point(const Eigen::Matrix4d& matrix, const double* point);

}  // namespace crowdface

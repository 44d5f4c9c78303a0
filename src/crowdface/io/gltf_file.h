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

/// A glTF 2.0 scene and its buffers, with messages that name the file.
class GltfFile {
 public:
  using Json = nlohmann::ordered_json;

  /// \param bytes  of a GLB file, or of JSON text; must outlive this object.
  /// \param path   beside which further buffers lie.
  /// \throws InvalidInput
  GltfFile(std::string_view bytes, std::filesystem::path path);

  const Json& scene() const { return scene_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// The numbers of an accessor, row after row; those that are normalized as what they stand for, sparse ones filled in.
  /// \throws InvalidInput if one is not finite.
  std::vector<double> numbers(std::size_t accessor, std::size_t width);
  /// The same where they count something.
  std::vector<std::uint32_t> whole_numbers(std::size_t accessor, std::size_t width);
  /// What a URI stands for: data within it, or a file beside. \param what  for messages: "its buffer 2"
  std::string resource(const std::string& uri, const std::string& what) const;
  /// What a view of a buffer holds, uncompressed.
  std::string_view view(std::size_t number);

  /// #nodes, the node that each hangs on, or kNoIndex.
  std::vector<std::uint32_t> parents() const;
  /// #nodes, from a node's axes to the file's.
  std::vector<Eigen::Matrix4d> worlds(const std::vector<std::uint32_t>& parents) const;

 private:
  std::string_view buffer(std::size_t number);
  /// Reads `count` rows of `width` numbers from buffer view `number`.
  std::vector<double> numbers_in(std::size_t number, std::size_t begin, int type, std::size_t count,
                                 std::size_t width, std::size_t accessor);
  void require_room(std::size_t more);

  std::filesystem::path path_;
  Json scene_;
  std::string_view binary_;
  std::map<std::size_t, std::string> own_buffers_, own_views_;
  std::size_t room_ = 0;  ///< numbers that may still be read
};

/// A matrix of 16 numbers, column by column.
Eigen::Matrix4d matrix_from(const std::vector<double>& columns);
/// Written out: a library's product chooses its order by the machine.
Eigen::Matrix4d times(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b);
/// A point (three numbers) moved by a matrix, written out likewise.
Eigen::Vector3d moved(const Eigen::Matrix4d& by, const double* point);

}  // namespace crowdface

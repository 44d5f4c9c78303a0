// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/given_normals.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Writes copies of an OBJ file with other positions. A copy differs from the file only in the
/// numbers of the `v` and `vn` lines. The object is built once per target file. In addition to the
/// text, the object needs 16 bytes per `v` or `vn` line.
class ObjTemplate {
 public:
  /// \param target  the file to copy. Only its mapped text must outlive this object and the encoded
  ///                files.
  /// \param topology  the polygons, which all heads share; must outlive this object.
  /// \param colours  whether each file has its own colours after the coordinates of its `v` lines.
  /// \param fixed  normals that replace the computed normals of some vertices. A `vn` line gets
  ///               such a normal only if no other vertex uses the same line.
  ObjTemplate(const ObjFile& target, const Topology& topology, bool colours = false,
              const GivenNormals& fixed = {});

  /// Encodes a copy of the file with these positions. Each number is the shortest text that reads
  /// back as the same single-precision value. Each normal is recomputed from the polygons whose
  /// corners use it; an unused normal keeps its text. The bytes do not depend on the number of
  /// threads.
  /// \param positions  #V by 3, in the file's unit.
  /// \param what  names the mesh in messages.
  /// \param colours  one row per vertex if files have colours; written as red, green and blue from
  ///                 0 to 1 with four digits.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  EncodedFile encode(const Positions& positions, const std::string& what,
                     const ColourRows& colours = {}) const;

  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const;
  /// Upper bound of the memory needed to encode one file, including the result, in bytes. Numbers
  /// rarely have their maximum length, so encoding a file touches about half of this memory.
  std::size_t encoding_memory_bytes() const;

 private:
  /// The range of the text that holds the numbers of one `v` or `vn` line. `row` counts the `v`
  /// lines or the `vn` lines from 0.
  struct NumberRange {
    std::uint64_t begin = 0;   ///< offset in the text
    std::uint32_t length = 0;  ///< number of characters of the range
    std::uint32_t row : 31 = 0;
    std::uint32_t is_normal : 1 = 0;
  };
  /// A sequence of number ranges in the text. One thread formats all ranges of a block.
  struct Block {
    /// offset in the text at which the block starts: the end of the preceding block
    std::uint64_t begin = 0;
    std::uint64_t end = 0;            ///< offset in the text at which the block ends
    std::uint64_t output_offset = 0;  ///< offset in the output buffer at which the block starts
    /// the number ranges of the block, in the order of the text
    std::vector<NumberRange> ranges;
  };
  /// The new values of the `v` and `vn` lines.
  struct NewValues {
    const Positions& positions;  ///< new positions, one row per `v` line
    const Positions& normals;    ///< new normals, one row per `vn` line
    const ColourRows& colours;   ///< new colours, one row per `v` line; or no rows
  };

  /// Sets `given_normals_`: adds the normals of those vertices in `given` whose `vn` line no other
  /// vertex uses.
  /// \param corner_rows  for each polygon corner, the index of its `vn` line, or kNoIndex.
  void set_given_normals(const std::vector<std::uint32_t>& corner_rows, const GivenNormals& given);
  /// Appends a block that consists of these ranges and the text between the ranges.
  void add_block(const std::vector<NumberRange>& ranges);
  /// Writes the text of a block with new numbers.
  /// \return the end of the output.
  char* encode_block(const Block& block, const NewValues& rows, char* out) const;
  /// Writes the new numbers of one line.
  /// \return the end of the output.
  char* encode_range(const NumberRange& range, const NewValues& rows, char* out) const;

  std::string_view text_;  ///< the text of the file to copy
  const Topology& topology_;
  Index vertex_count_ = 0;
  bool has_colours_;           ///< whether each file has its own colours
  std::vector<Block> blocks_;  ///< the blocks, in the order of the text
  /// The normals that are not computed. Each element is the index of a `vn` line (counted among the
  /// `vn` lines) and the normal for this line.
  std::vector<std::pair<std::uint32_t, Eigen::RowVector3d>> given_normals_;
  /// For each `vn` line, the polygons whose corners use it; nothing if no polygon uses normals.
  std::optional<NormalFans> fans_;
  std::size_t buffer_size_ = 0;  ///< upper bound of the output's length
};

}  // namespace crowdface

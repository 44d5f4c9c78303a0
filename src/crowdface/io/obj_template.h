// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// An OBJ file as a form to be filled in with other positions, over and over. Every byte but the
/// x y z of `v` lines (and of `vn` lines, if there are any) is the file's own, in whatever order
/// its lines stand. Made once a file; keeps 16 bytes a line beside the text.
class ObjTemplate {
 public:
  /// \param target    its mapped text is referred to and must outlive this object and the files it
  ///                  encodes; all else of it may go.
  /// \param topology  the faces, which all heads share; must outlive this object.
  /// \param colours   whether each file has colours of its own behind the coordinates of its `v` lines
  ObjTemplate(const ObjFile& target, const Topology& topology, bool colours = false);

  /// The file with these positions. Numbers are the shortest that read back as the same
  /// single-precision value. A normal is recomputed from the faces whose corners use it; one that
  /// no face uses stays as it is. The same bytes for any number of threads.
  /// \param positions  #V by 3, in the file's unit.
  /// \param what       names the mesh in messages.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  /// \param colours  #V if files have them: red, green and blue from 0 to 1 with four digits.
  EncodedFile encode(const Positions& positions, const std::string& what,
                     const ColourRows& colours = {}) const;

  /// What this object itself takes.
  std::size_t memory_bytes() const;
  /// What one encode takes at most, the result included: numbers are seldom as long as they might
  /// be, so that it touches about half of this.
  std::size_t encode_bytes() const;

 private:
  /// The numbers of one `v` or `vn` line.
  struct Place {
    std::uint64_t begin = 0;
    std::uint32_t length = 0;
    std::uint32_t row : 31 = 0;
    std::uint32_t is_normal : 1 = 0;
  };
  /// A run of places, formatted by one thread.
  struct Block {
    std::uint64_t begin = 0;   ///< where in the text its share begins: after the place before it
    std::uint64_t end = 0;     ///< after its last place
    std::uint64_t buffer = 0;  ///< where its output goes
    std::vector<Place> places;
  };
  struct Rows {
    const Positions& positions;
    const Positions& normals;
    const ColourRows& colours;
  };

  void add_block(const std::vector<Place>& places);
  char* encode_block(const Block& block, const Rows& rows, char* out) const;
  char* encode_place(const Place& place, const Rows& rows, char* out) const;

  std::string_view text_;
  const Topology& topology_;
  Index vertices_ = 0;
  bool colours_;
  std::vector<Block> blocks_;
  std::optional<NormalFans> fans_;  ///< of the `vn`, if faces use any
  std::size_t buffer_size_ = 0;
};

}  // namespace crowdface

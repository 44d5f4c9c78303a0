// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/io/npy_array.h"

namespace crowdface {

/// A table of weights with one row per vertex and named or unnamed columns, for example painted in
/// another program.
struct VertexWeights {
  NpyArray rows;                   ///< one row of weights per vertex
  std::vector<std::string> names;  ///< names of the columns, if the file has a header line
};

/// Whether a mask file holds a row of weights for each vertex instead of pixels. The extension
/// decides: .npy, .txt or .csv.
bool holds_vertex_weights(const std::filesystem::path& path);

/// Reads a NumPy array, or lines of numbers separated by blanks, commas or semicolons, with an
/// optional header line; `#` starts a comment. Ignores quotes around words. Also ignores the first
/// column if it has no name and numbers the rows. Values from kMinMaskValue to 0 count as 0.
/// \throws MissingInput if there is no such file.
/// \throws InvalidInput if a number is below kMinMaskValue or not finite, or if rows differ in
///         length.
VertexWeights read_vertex_weights(const std::filesystem::path& path);

}  // namespace crowdface

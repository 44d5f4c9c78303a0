// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/io/npy_array.h"

namespace crowdface {

/// Weights of vertices in columns, such as painted in another program.
struct VertexWeights {
  NpyArray rows;                   ///< #V by columns
  std::vector<std::string> names;  ///< of the columns, if a first line tells them
};

/// Whether a mask's file holds a row of weights for each vertex (.npy, .txt, .csv), and not pixels.
bool holds_vertex_weights(const std::filesystem::path& path);

/// Reads an array of NumPy, or lines of numbers that stand between blanks, commas or semicolons.
/// \throws MissingInput; InvalidInput if numbers are negative or not finite, or rows differ in length.
VertexWeights read_vertex_weights(const std::filesystem::path& path);

}  // namespace crowdface

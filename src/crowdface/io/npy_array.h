// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// An array of numbers in NumPy's file format.
struct NpyArray {
  std::vector<std::size_t> shape;  ///< length of each dimension
  std::vector<double> values;      ///< the numbers in C order: the last index varies fastest

  /// Length of the first dimension; 1 for a single number.
  std::size_t rows() const { return shape.empty() ? 1 : shape[0]; }
  /// Number of values for each index of the first dimension; 0 for an empty array.
  std::size_t width() const { return rows() == 0 ? 0 : values.size() / rows(); }
};

/// Parses an array in NumPy's format (versions 1 to 3, either byte order, C or Fortran order).
/// Values may be integers of any size, booleans, or floats of 2 to 8 bytes.
/// \param name  name of the file, for messages.
/// \throws InvalidInput.
NpyArray parse_npy(std::string_view bytes, const std::string& name);
/// The shape of the array in a file. Nothing if the file cannot be read or has another format.
std::optional<std::vector<std::size_t>> npy_shape(const std::filesystem::path& path);
/// Reads a file in NumPy's format.
/// \throws MissingInput, InvalidInput.
NpyArray read_npy_array(const std::filesystem::path& path);

}  // namespace crowdface

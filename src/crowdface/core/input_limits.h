// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace crowdface {

/// Maximum sizes of inputs. A larger input is rejected before its memory is allocated, so that a
/// hostile or broken file causes an error message instead of exhausting the machine.
struct InputLimits {
  std::uint64_t vertices = 1ULL << 26U;  ///< largest number of vertices of a mesh
  std::uint64_t faces = 1ULL << 26U;     ///< largest number of polygons (faces) of a mesh
  /// largest product of width and height of a mask or texture
  std::uint64_t image_pixels = 1ULL << 28U;
  /// largest memory for the pixels of all images together, in bytes
  std::uint64_t image_bytes = 1ULL << 32U;
  std::uint64_t textures = 1000;           ///< largest number of textures of one head
  std::uint64_t yaml_bytes = 1ULL << 20U;  ///< largest size of a config or review file, in bytes
  /// largest nesting depth of lists and mappings in a config or review file
  std::uint64_t yaml_depth = 64;
};

/// The current limits.
const InputLimits& input_limits();

/// Sets one limit by its field name, such as "vertices=2000000". Call this function at program
/// start, before any thread starts.
/// \throws UsageError if there is no such limit, or if the number is not between 1 and 2^31
///         (image_bytes: 2^50).
void set_input_limit(std::string_view assignment);

/// Lowers the limit `image_bytes` to `bytes` if the limit is larger than `bytes`. Call this
/// function at program start.
void limit_image_memory(std::uint64_t bytes);

/// Names and default values of all limits, for help texts: "vertices (67108864), faces (…), …".
std::string describe_input_limits();

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace crowdface {

/// How large an input may be. What is larger is refused before memory is taken for it, so that a
/// hostile or mistaken file costs a message and not the machine.
struct InputLimits {
  std::uint64_t vertices = 1ULL << 26U;      ///< of a mesh
  std::uint64_t faces = 1ULL << 26U;         ///< of a mesh
  std::uint64_t image_pixels = 1ULL << 28U;  ///< width times height of a mask or texture
  std::uint64_t image_bytes = 1ULL << 32U;   ///< of memory, for the pixels of all images together
  std::uint64_t textures = 1000;             ///< that a head's material files name
  std::uint64_t yaml_bytes = 1ULL << 20U;    ///< of a config or review file
  std::uint64_t yaml_depth = 64;             ///< lists and mappings within each other
};

/// Those in force.
const InputLimits& input_limits();

/// Sets one of them by its field's name, "vertices=2000000". At start, before any thread.
/// \throws UsageError if there is no such limit or the number is none from 1 to 2^31 (of bytes of
///         memory: 2^50).
void set_input_limit(std::string_view assignment);

/// From now on images take no more memory than this, whatever was set before. At start.
void limit_image_memory(std::uint64_t bytes);

/// "vertices (67108864), faces (…), …", for help texts.
std::string describe_input_limits();

}  // namespace crowdface

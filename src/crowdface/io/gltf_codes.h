// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Codes of the glTF 2.0 specification.
namespace gltf {
inline constexpr int kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123;
inline constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
}  // namespace gltf

}  // namespace crowdface

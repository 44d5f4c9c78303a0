// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

// Whoever changes an algorithm so that bytes change raises the constant beside them and makes tests/golden
// anew. What an older version made then counts as not done.

inline constexpr int kBlendVersion =
    7;  ///< positions of a face's skin; in `settings` of every recipe
inline constexpr int kPartsVersion =
    5;  ///< where parts come to lie; in `settings` of heads with parts
inline constexpr int kMirrorVersion =
    1;  ///< the other side of each vertex; in `settings` where faces may be mirrored
/// Entries of the cache, and so the faces made of them.
inline constexpr int kPrepareVersion = 6;
inline constexpr int kPatchVersion =
    1;  ///< all heads' fields on patches, and the faces made of them
/// Where casting finds faces to lie, and so the plans made there.
inline constexpr int kFaceSpaceVersion = 1;
/// What the cache keeps besides: neighbours, masks at vertices, samples and their cells, the other side.
inline constexpr int kSharedVersion = 1;
/// A picture, what is found about a skin, or a mesh file of the same positions.
inline constexpr int kFaceFilesVersion = 22;
inline constexpr int kShapesVersion =
    9;  ///< shapes carried to a face of the same positions, and shown
inline constexpr int kPointsVersion = 1;       ///< points that follow a face of the same positions
inline constexpr int kRigVersion = 1;          ///< joints that follow, and what is bound to them
inline constexpr int kAttachmentsVersion = 5;  ///< attachments of a face of the same positions
inline constexpr int kLevelsVersion = 1;       ///< levels of detail of the same heads
inline constexpr int kTextureVersion = 3;      ///< textures of faces' own
inline constexpr int kSheetVersion = 17;  ///< contact sheets and the gallery, of the same pictures

}  // namespace crowdface

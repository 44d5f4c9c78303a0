// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

// Version numbers of algorithms. When the output bytes of an algorithm change, raise its constant
// and regenerate tests/golden. Results of an older version are then made again.

/// Skin positions of a face; in the `settings` of every recipe.
inline constexpr int kBlendVersion = 7;
/// Placement of parts; in the `settings` of heads with parts.
inline constexpr int kPartsVersion = 5;
/// Mirror vertex of each vertex; in the `settings` where faces may be mirrored.
inline constexpr int kMirrorVersion = 1;
/// Cache entries of heads, and the faces made from them.
inline constexpr int kPrepareVersion = 6;
/// Patch fields of all heads, and the faces made from them.
inline constexpr int kPatchVersion = 1;
/// Coordinates of faces in the space that casting samples, and the plans made from them.
inline constexpr int kFaceSpaceVersion = 1;
/// Crowd plans, where config and heads are unchanged.
inline constexpr int kCastVersion = 2;
/// Cache entries that all heads share: neighbours, masks at vertices, samples and their cells,
/// mirror vertices.
inline constexpr int kSharedCacheVersion = 1;
/// Images and skin measurements of a face, and its mesh files, where the positions are unchanged.
inline constexpr int kFaceFilesVersion = 25;
/// Shapes transferred to a face whose positions are unchanged, and rendered images of these shapes.
inline constexpr int kShapesVersion = 9;
/// Points that follow a face of unchanged positions.
inline constexpr int kPointsVersion = 2;
/// Joints that follow the face, and the skin weights bound to them.
inline constexpr int kRigVersion = 1;
/// Placement of heads and faces on a body, and bending of necks to the body's neck ring.
inline constexpr int kNeckVersion = 4;
/// Attachments of a face of unchanged positions.
inline constexpr int kAttachmentsVersion = 6;
/// Levels of detail of unchanged heads.
inline constexpr int kLevelsVersion = 1;
/// Blended textures of faces.
inline constexpr int kTextureVersion = 3;
/// Contact sheets and galleries whose rendered images are unchanged.
inline constexpr int kSheetVersion = 17;

}  // namespace crowdface

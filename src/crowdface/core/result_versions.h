// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

// Version numbers of algorithms. When the output bytes of an algorithm change, raise its constant
// and regenerate tests/golden. The program then recomputes results of older versions.

/// Version of the skin positions of a face. Part of the `settings` of every recipe.
inline constexpr int kBlendVersion = 7;
/// Version of the placement of parts such as eyes and teeth. Included in the `settings` if heads
/// have parts.
inline constexpr int kPartsVersion = 5;
/// Version of the mirror vertices. Included in the `settings` if faces may be mirrored.
inline constexpr int kMirrorVersion = 1;
/// Cache entries of heads, and the faces made from these entries.
inline constexpr int kPrepareVersion = 6;
/// Compressed fields of all heads (FieldPatches), and the faces made from these fields.
inline constexpr int kPatchVersion = 1;
/// Coordinates of faces in the space that casting samples, and the plans made from these
/// coordinates.
inline constexpr int kFaceSpaceVersion = 1;
/// Crowd plans of unchanged config and heads.
inline constexpr int kCastVersion = 2;
/// Cache entries that all heads share: neighbours, masks at vertices, samples and their cells,
/// mirror vertices.
inline constexpr int kSharedCacheVersion = 1;
/// Images, skin measurements and mesh files of a face with unchanged positions.
inline constexpr int kFaceFilesVersion = 25;
/// Blend shapes transferred to a face with unchanged positions, and rendered images of these
/// shapes.
inline constexpr int kShapesVersion = 9;
/// Points that follow a face with unchanged positions.
inline constexpr int kPointsVersion = 2;
/// Joints that follow the face, and the skin weights bound to them.
inline constexpr int kRigVersion = 1;
/// Placement of heads and faces on a body, and bending of necks to the body's neck ring.
inline constexpr int kNeckVersion = 4;
/// Attachments of a face with unchanged positions.
inline constexpr int kAttachmentsVersion = 6;
/// Levels of detail of unchanged heads.
inline constexpr int kLevelsVersion = 1;
/// Blended textures of faces.
inline constexpr int kTextureVersion = 3;
/// Contact sheets and galleries whose rendered images are unchanged.
inline constexpr int kSheetVersion = 17;

}  // namespace crowdface

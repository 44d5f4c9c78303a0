// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

// Version numbers of algorithms. When the output bytes of an algorithm change, raise its constant
// and regenerate tests/golden. The program then recomputes results of older versions.

/// Version of the computation of a face's skin vertices. Part of the hash `settings` of every
/// recipe.
inline constexpr int kBlendVersion = 7;
/// Version of the placement of parts such as eyes and teeth. Included in the `settings` if heads
/// have parts.
inline constexpr int kPartsVersion = 5;
/// Version of the search for each vertex's mirror point. Included in the `settings` if faces may be
/// mirrored.
inline constexpr int kMirrorVersion = 1;
/// Version of the cache entries of heads, and of the faces made from these entries.
inline constexpr int kPrepareVersion = 6;
/// Version of the compressed fields of all heads (FieldPatches), and of the faces made from these
/// fields.
inline constexpr int kPatchVersion = 1;
/// Version of the coordinates of faces in the space that casting samples, and of the plans made
/// from these coordinates.
inline constexpr int kFaceSpaceVersion = 2;
/// Version of crowd plans; raised if the same config and heads give another plan.
inline constexpr int kPlanVersion = 6;
/// Version of the cache entries that all heads share: neighbours, masks at vertices, samples and
/// their cells, mirror vertices.
inline constexpr int kSharedCacheVersion = 1;
/// Version of the images, skin measurements and mesh files made from the positions of a face.
inline constexpr int kFaceFilesVersion = 27;
/// Version of the blend shapes transferred to a face, and of the rendered images of these shapes.
inline constexpr int kShapesVersion = 9;
/// Version of the named points (config section `points`) that move with the surface of a face.
inline constexpr int kPointsVersion = 2;
/// Version of the joints that follow a face, and of the skin weights bound to these joints.
inline constexpr int kRigVersion = 1;
/// Version of the placement of heads and faces on a body, and of the bending of necks to the body's
/// neck ring.
inline constexpr int kNeckVersion = 4;
/// Version of the attachments fitted to a face.
inline constexpr int kAttachmentsVersion = 6;
/// Version of the levels of detail of the heads' mesh.
inline constexpr int kLevelsVersion = 1;
/// Version of the blended textures of faces.
inline constexpr int kTextureVersion = 4;
/// Version of the contact sheets and galleries made from rendered images.
inline constexpr int kSheetVersion = 18;

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/texture.h"

namespace crowdface {

/// The textures that the heads' own materials name (`map_Kd`).
struct HeadTextures {
  std::vector<TextureCoat> coats;  ///< #heads, or empty: surfaces have their own colours
  Digest digest;  ///< of the files read, and of which face of which head wears which
  std::vector<std::string> warnings;  ///< about files that are missing
};

/// Reads them, each file once. PNG, TIFF and JPEG are taken for sRGB, floats for linear light.
/// \param faces    the topology and coordinates that all heads share.
/// \param files    #heads.
/// \param most_px  larger textures are made smaller: more than this no picture shows.
/// \throws MissingInput if no face of any head gets a texture; InvalidInput if a file is damaged.
HeadTextures load_textures(const FaceSet& faces, std::span<const ObjFile> files, int most_px);

}  // namespace crowdface

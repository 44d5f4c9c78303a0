// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/bake/bake_template.h"
#include "crowdface/bake/scan_bake.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/run/wrap_inputs.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// The texture and material files of one wrapped head.
struct TextureFiles {
  std::filesystem::path material_file;           ///< the material file, beside the head's OBJ file
  std::vector<std::filesystem::path> map_files;  ///< one colour texture per image
  /// masks (in the folder of the report) that mark the texels of the head that the scan does not
  /// show
  std::vector<std::filesystem::path> mask_files;

  /// Returns the paths of the material file, maps and masks; empty if the template has no images.
  std::vector<std::filesystem::path> all_paths() const;
};

/// Bakes and writes the textures of wrapped heads (`wrap --texture`).
class WrapTextures {
 public:
  /// \param inputs  must outlive this object.
  WrapTextures(const WrapOptions& options, const WrapInputs& inputs);

  /// Returns the paths of the texture files of a head.
  /// \param head     the head's OBJ file
  /// \param reports  folder for the masks and the head's report
  TextureFiles files_of(const std::filesystem::path& head,
                        const std::filesystem::path& reports) const;

  /// Bakes the textures of a head, and writes these textures and the head's material file.
  /// \return the share of the skin's texels, 0 to 1, that the scan does not show.
  double write(const WrapResult& result, const Scan& skin, const ScanColours& colours,
               const TextureFiles& files) const;

  /// Adds the `mtllib` line, which names the head's material file, to the head's OBJ file. Also
  /// adds a `usemtl` line if the template's skin has no material.
  /// \param plain  the OBJ file as exported without baked textures
  EncodedFile with_material_lines(EncodedFile plain, const TextureFiles& files) const;

 private:
  /// Copies the textures of the template that the head keeps unchanged, such as the textures of the
  /// eyes.
  void copy_other_textures(const std::filesystem::path& folder) const;
  /// Returns the text of a head's material file, which names the baked textures.
  std::string materials_text(const TextureFiles& files) const;

  const WrapInputs& inputs_;
  BakeOptions options_;
  BakeTemplate bake_template_;  ///< the template, prepared for baking
};

/// Adds hashes to `hasher`: the hashes of all material files and textures that an OBJ file of a
/// scan names.
void add_texture_files(const std::filesystem::path& scan, Hasher& hasher);

}  // namespace crowdface

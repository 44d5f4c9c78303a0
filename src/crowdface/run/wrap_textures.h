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
  /// masks of the texels that the scan does not show, in the folder of the report
  std::vector<std::filesystem::path> mask_files;

  /// The paths of all these files; empty if the template has no images.
  std::vector<std::filesystem::path> all_paths() const;
};

/// Bakes and writes the textures of wrapped heads (`wrap --texture`).
class WrapTextures {
 public:
  /// \param inputs  must outlive this object.
  WrapTextures(const WrapOptions& options, const WrapInputs& inputs);

  /// \param reports  folder for the head's report, which also receives the masks.
  TextureFiles files_of(const std::filesystem::path& head,
                        const std::filesystem::path& reports) const;

  /// Bakes the textures of a head, and writes these textures and the head's material file.
  /// \return the share of the skin's texels, 0 to 1, that the scan does not show.
  double write(const WrapResult& result, const Scan& scan, const ScanColours& colours,
               const TextureFiles& files) const;

  /// Returns the head's OBJ file with a line that names the material file.
  EncodedFile head_file(EncodedFile plain, const TextureFiles& files) const;

 private:
  void copy_other_textures(const std::filesystem::path& folder) const;
  std::string materials_text(const TextureFiles& files) const;

  const WrapInputs& inputs_;
  BakeOptions options_;
  BakeTemplate target_;
};

/// Hashes the material files and textures that an OBJ scan names.
void add_texture_files(const std::filesystem::path& scan, Hasher& hasher);

}  // namespace crowdface

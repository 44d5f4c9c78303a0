// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/settings_digest.h"

#include <filesystem>
#include <set>
#include <span>

#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/units.h"

namespace crowdface {
namespace {

/// Adds to the hash everything that determines how parts move. Adds nothing if all components are
/// skin.
void add_parts(const Config& config, const PartList& parts, Hasher& hasher) {
  if (parts.parts.empty()) return;
  hasher.add(kPartsVersion).add(static_cast<int>(config.parts.shape));
  for (const Axis& axis : {config.faces.up, config.faces.front}) {
    hasher.add(axis.index).add(axis.sign);
  }
  for (const Part& part : parts.parts) {
    hasher.add(static_cast<int>(part.part_class)).add_array(std::span(part.components));
  }
}

}  // namespace

Digest settings_digest(const Config& config, const Inputs& inputs) {
  Hasher hasher;
  hasher.add(kBlendVersion).add(inputs.topology_digest).add(inputs.mask_digest);
  for (std::size_t h = 0; h < inputs.head_digests_before_placement.size(); ++h) {
    // Also hash the text of each head's file: an output mesh copies everything except the positions
    // from the file of its target head.
    hasher.add(config.faces.names[h])
        .add(inputs.head_digests_before_placement[h])
        .add(inputs.head_file_digests[h]);
  }
  for (const std::string& region : config.region_names()) hasher.add(region);
  hasher.add(static_cast<int>(config.smoothing.boundary))
      .add(static_cast<int>(config.smoothing.operator_kind))
      .add(static_cast<int>(config.smoothing.levels));
  // Only fitted levels depend on max_level. Exactly computed levels do not.
  if (config.smoothing.levels != LevelRepresentation::kExact) hasher.add(inputs.max_level);
  if (config.smoothing.levels == LevelRepresentation::kBasis) {
    hasher.add(config.smoothing.tolerance_mm / mm_per(config.faces.units));
  }
  hasher.add(static_cast<int>(config.blending.contacts));
  add_parts(config, inputs.parts, hasher);
  if (inputs.mirror_map != nullptr) {
    hasher.add(kMirrorVersion).add(config.faces.up.index).add(config.faces.front.index);
  }
  return hasher.digest();
}

Digest materials_digest(const Inputs& inputs) {
  const bool has_colours = inputs.textures.digest != Digest();
  std::set<std::filesystem::path> known;  // a set, because heads mostly share their material files
  Hasher hasher;
  for (const ObjFile& head : inputs.head_files) {
    for (const MaterialFile& file :
         find_material_files(head.material_path(), head.material_libraries).files) {
      const bool is_hashed = file.kind && (*file.kind != TextureKind::kColour || has_colours);
      if (is_hashed || !known.insert(file.source).second) continue;
      throw_if_interrupted();
      hasher.add(file.destination.generic_string()).add(hash_file(file.source).digest);
    }
  }
  return known.empty() ? Digest() : hasher.digest();
}

}  // namespace crowdface

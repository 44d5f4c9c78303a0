// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/head_mirror.h"

#include "crowdface/cast/sampling.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/heads/shared_by_heads.h"

namespace crowdface {
namespace {

/// Smallest allowed fraction of vertices with a mirror partner.
constexpr double kMinShare = 0.9;

std::string key_of(const SamplingOptions& sampling, const std::string& section) {
  if (sampling.asymmetry != Range{1, 1}) return concat(section, ".asymmetry");
  if (sampling.mirror != Mirroring::kNone) return concat(section, ".mirror");
  return {};
}

}  // namespace

std::string mirroring_key(const Config& config) {
  std::string key = key_of(*config.sampling, "sampling");
  for (const Group& group : config.groups) {
    if (key.empty()) key = key_of(group.sampling, concat("groups.", group.name));
  }
  for (const ManualRecipe& recipe : config.recipes) {
    if (!key.empty()) break;
    if (recipe.asymmetry.value_or(Range{1, 1}) != Range{1, 1}) {
      key = concat("recipes.", recipe.id, ".asymmetry");
    } else if (recipe.mirrored.value_or(false)) {
      key = concat("recipes.", recipe.id, ".mirrored");
    }
  }
  return key;
}

FoundMirror find_mirror(const Config& config, const Inputs& inputs) {
  return find_cached_mirror(inputs, head_axes(config).side());
}

std::shared_ptr<const MirrorMap> required_mirror_map(const Config& config, const Inputs& inputs,
                                                     const std::string& key) {
  if (inputs.mirror_map != nullptr) return inputs.mirror_map;
  FoundMirror found = find_mirror(config, inputs);
  if (found.partner_fraction() < kMinShare) {
    throw InvalidInput(concat(config.file.string(), ": ", key, ": the heads are not symmetric ",
                              "enough: expected ", 100 * kMinShare, " % of the vertices to have ",
                              "a mirror image, found ", describe_mirror(config, found),
                              "; remove this key, or use heads with a symmetric mesh"));
  }
  return std::make_shared<const MirrorMap>(std::move(found.map));
}

std::string describe_mirror(const Config& config, const FoundMirror& mirror) {
  const double mm = mm_per(config.faces.units);
  const auto all = static_cast<Index>(mirror.map.corners.size());
  const Index with_partner = mirror.paired_vertex_count + mirror.surface_mirrored_vertex_count;
  std::string text = concat(with_partner, " of ", all, " vertices with a mirror image");
  if (mirror.surface_mirrored_vertex_count > 0) {
    text += concat(", ", mirror.surface_mirrored_vertex_count,
                   " of them on the surface between vertices");
  }
  return concat(text, "; the mean head is ", format_fixed(mm * mirror.rms_distance, 2),
                " mm from its mirror image (rms), ", format_fixed(mm * mirror.max_distance, 2),
                " at most");
}

}  // namespace crowdface

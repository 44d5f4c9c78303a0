// SPDX-License-Identifier: Apache-2.0
#include "crowdface/paint/proposed_masks.h"

#include "crowdface/core/contains.h"
#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::string_view kForm =
    "brow,nose,mouth and, if wanted, ears and neck, with commas between";

MaskBand band_of(std::string_view name) {
  for (const auto& [known, band] : kMaskBandNames) {
    if (known == name) return band;
  }
  throw UsageError(concat("--bands: expected ", kForm, ", found ", quoted(name)));
}

}  // namespace

std::vector<MaskBand> parse_bands(std::string_view text) {
  std::vector<MaskBand> bands;
  for (const std::string_view name : split(text, ',')) {
    const MaskBand band = band_of(name);
    if (contains(bands, band)) {
      throw UsageError(concat("--bands: ", name, " is given twice"));
    }
    bands.push_back(band);
  }
  for (const MaskBand band : {MaskBand::kBrow, MaskBand::kNose, MaskBand::kMouth}) {
    if (contains(bands, band)) continue;
    throw UsageError(concat("--bands: expected ", kForm, ", found ", join(names_of(bands))));
  }
  return bands;
}

std::vector<std::string> names_of(const std::vector<MaskBand>& bands) {
  std::vector<std::string> names;
  for (const MaskBand band : bands) {
    names.emplace_back(kMaskBandNames[static_cast<std::size_t>(band)].first);
  }
  return names;
}

int mask_side_texels(Index vertex_count) {
  constexpr Index kMany = 100'000;
  return vertex_count > kMany ? 2048 : 1024;
}

RegionWeights::Alpha propose_regions(const Topology& topology, const HeadShape& mean,
                                     const Orientation& orientation,
                                     const std::vector<MaskBand>& bands) {
  const auto marks = find_face_marks(topology, mean, axes_of(orientation));
  if (!marks) {
    throw InvalidInput(concat("no face is found that looks along ", name_of(orientation.front),
                              " with ", name_of(orientation.up), " up on the mean head: ",
                              why_no_face_found(topology, mean, axes_of(orientation)),
                              "; or paint the mask by hand"));
  }
  return propose_bands(topology, mean, *marks, bands);
}

PaintedMasks propose_masks(const HeadSet& heads, const HeadShape& mean,
                           const Orientation& orientation, const std::vector<MaskBand>& bands,
                           int size) {
  if (heads.topology.corner_uvs.empty()) {
    throw InvalidInput(
        "the heads have no texture coordinates (vt lines), which a mask image needs: unwrap the "
        "mesh, the same way for all heads, or blend without regions");
  }
  return paint_masks(heads.topology, heads.uvs,
                     propose_regions(heads.topology, mean, orientation, bands), mean.is_skin, size,
                     heads.heads[0].name);
}

}  // namespace crowdface

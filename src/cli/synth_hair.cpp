// SPDX-License-Identifier: Apache-2.0
#include "cli/synth_hair.h"

#include <algorithm>
#include <memory>
#include <span>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "head_models/synth/complexion.h"
#include "head_models/synth/hair.h"
#include "head_models/synth/hair_cards.h"
#include "head_models/synth/hair_picture.h"
#include "head_models/synth/identity.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSize = 512;
constexpr double kBald = 0.55;  // Complexion::receding above which the crown is bald

const char* form_tag(bool curly, bool bald) {
  if (bald) return "bald";
  return curly ? "curly_hair" : "straight_hair";
}

/// \param tone  synth::Complexion::tone.
const char* skin_tag(double tone) {
  if (tone < 1 / 3.0) return "light_skin";
  return tone < 2 / 3.0 ? "medium_skin" : "dark_skin";
}

bool is_for(const synth::HairCut& cut, bool female, bool curly, bool bald) {
  return cut.female == female && cut.curly == curly && cut.crown_bald == bald;
}

std::string picture_name(const std::string& colour, bool curly) {
  return concat(colour, curly ? "_curly.png" : "_straight.png");
}

}  // namespace

std::string SynthHair::add_head(std::uint64_t seed, std::uint64_t index) {
  const synth::Complexion look = synth::draw_complexion(seed, index);
  const std::string skin = skin_tag(look.tone);
  const bool bald = look.receding > kBald;
  const Wish wish{synth::draw_person(seed, index).male < 0, !bald && synth::has_curls(seed, index),
                  bald, std::string(synth::nearest_hair_colour(look.hair).name)};
  wishes_.insert(wish);
  return concat(skin, ", ", wish.colour, "_hair, ", form_tag(wish.curly, wish.bald));
}

void SynthHair::add_files(const fs::path& directory, const SyntheticHeads& heads,
                          const std::vector<MaterialRange>& materials,
                          std::vector<HeadFile>& files) const {
  const fs::path folder = directory / "attachments";
  files.push_back({folder / "base.obj", [&heads, materials] {
                     return encode_obj({heads.topology(), heads.average(), heads.uvs()},
                                       "the average synthetic head, made by crowdface synth; cm",
                                       materials);
                   }});
  std::string section =
      "# For \"attachments: {from: THIS_FOLDER}\" in a config. The tags are those of tags.yaml.\n"
      "attachments:\n  fitted_to: base.obj\n  items:";
  if (wishes_.empty()) section += " []";
  section += '\n';
  // All colours of a cut share one mesh.
  const std::span<const synth::HairCut> cuts = synth::hair_cuts();
  std::vector<std::shared_ptr<const Mesh>> meshes(cuts.size());  // null: no head may wear the cut
  parallel_for_each(cuts.size(), [&](std::size_t c) {
    const bool wished = std::ranges::any_of(wishes_, [&](const Wish& wish) {
      return is_for(cuts[c], wish.female, wish.curly, wish.bald);
    });
    if (wished) meshes[c] = std::make_shared<const Mesh>(synth::head_of_hair(cuts[c]));
  });
  std::set<std::string> pictures;
  for (const Wish& wish : wishes_) {
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      const synth::HairCut& cut = cuts[c];
      if (!is_for(cut, wish.female, wish.curly, wish.bald)) continue;
      const std::string name = concat(cut.name, "_", wish.colour);
      const std::string picture = picture_name(wish.colour, wish.curly);
      pictures.insert(picture);
      files.push_back({folder / concat(name, ".obj"), [mesh = meshes[c], name] {
                         return encode_obj(
                             *mesh, concat(name, " on base.obj, made by crowdface synth; cm"),
                             {{"hair", 0}}, concat(name, ".mtl"));
                       }});
      files.push_back(text_file(folder / concat(name, ".mtl"),
                                concat("newmtl hair\nKd 1 1 1\nmap_Kd textures/", picture, '\n')));
      section += concat("    - {name: ", name, ", kind: hair, file: ", name, ".obj, tags: [",
                        wish.female ? "female" : "male", ", ", wish.colour, "_hair, ",
                        form_tag(wish.curly, wish.bald), "], colour: ", wish.colour, "}\n");
    }
  }
  for (const synth::HairColour& colour : synth::hair_colours()) {
    for (const bool curly : {false, true}) {
      const std::string picture = picture_name(std::string(colour.name), curly);
      if (!pictures.contains(picture)) continue;
      files.push_back({folder / "textures" / picture, [&colour, curly] {
                         return encode_png(kPictureSize, kPictureSize, 4,
                                           synth::hair_picture(kPictureSize, colour.colour, curly));
                       }});
    }
  }
  files.push_back(text_file(folder / "attachments.yaml", std::move(section)));
}

}  // namespace crowdface::cli

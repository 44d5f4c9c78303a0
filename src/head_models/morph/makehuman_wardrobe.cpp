// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/makehuman_wardrobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/random.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct AgeShare {
  std::string_view name;
  double share;
};

/// Returns the blending weights of the package's skins for a person's age: linear interpolation
/// between 27, 42 and 64 years. According to the package, the skins show people of 27, 48 and 68
/// years, but the people look younger.
std::array<AgeShare, 3> age_shares(double years) {
  const double middle = std::clamp((years - 27) / (42 - 27), 0.0, 1.0);
  const double old = std::clamp((years - 42) / (64 - 42), 0.0, 1.0);
  return {{{"young", 1 - middle}, {"middleage", middle - old}, {"old", old}}};
}

/// Returns the path of the texture that the file of a skin refers to.
fs::path skin_picture(const fs::path& file) {
  try {
    const auto root = nlohmann::json::parse(read_file(file));
    return picture_path(file, root.at("mapDiffuse"));
  } catch (const nlohmann::json::exception& error) {
    refuse_file(file, concat("expected a skin: ", error.what()));
  }
}

struct EyeColour {
  std::string_view name;
  /// probabilities of this eye colour for people of African, Asian and Caucasian ancestry
  std::array<double, 3> share;
  IrisLook look;
};
constexpr auto kEyeColours =
    std::to_array<EyeColour>({{"brown", {0.9, 0.85, 0.25}, {"brownlight", 2.2, 0.1}},
                              {"brownlight", {0.1, 0.15, 0.25}, {"brownlight", 1.35, 0.15}},
                              {"green", {0, 0, 0.15}, {"green", 1.4, 0.35}},
                              {"grey", {0, 0, 0.17}, {"grey", 1.6, 0}},
                              {"blue", {0, 0, 0.18}, {"blue", 1.3, 0.4}}});

const EyeColour& eye_colour(std::string_view name) {
  const auto* found = std::ranges::find(kEyeColours, name, &EyeColour::name);
  require(found != kEyeColours.end(), "no eye colour ", name);
  return *found;
}

fs::path proxy(const fs::path& package, std::string_view kind, std::string_view name) {
  return package / "public/data/proxies" / kind / name / concat(name, ".json");
}

FittedMesh read_free(const fs::path& file, Index base_vertices) {
  FittedMesh mesh = read_fitted_mesh(file, base_vertices);
  if (!is_free(mesh.licence)) {
    refuse_file(file, concat("expected a free licence and an author, found ",
                             quoted(std::string_view(mesh.licence.licence)), " of ",
                             quoted(std::string_view(mesh.licence.author))));
  }
  return mesh;
}

const fs::path& only_picture(const FittedMesh& mesh, const fs::path& file) {
  if (mesh.pictures.empty() || mesh.pictures[0].path.empty()) {
    refuse_file(file, "expected a material with a picture, found none");
  }
  return mesh.pictures[0].path;
}

/// Returns whether the texture is fully transparent at every corner of a polygon.
bool is_clear(const Image& image, const FittedMesh& mesh, Index face) {
  if (image.alpha_channel < 0) return false;
  const auto texel = [](double place, int count) {
    return std::clamp(static_cast<int>(std::floor(place * count)), 0, count - 1);
  };
  return std::ranges::all_of(mesh.topology.face_uvs(face), [&](std::uint32_t uv) {
    const int x = texel(mesh.uvs(uv, 0), image.width);
    const int y = texel(1 - mesh.uvs(uv, 1), image.height);
    return image.at(x, y, image.alpha_channel) == 0;
  });
}

void add_eyeballs(const FittedMesh& eyes, const fs::path& file, const Positions& base,
                  MakeHumanParts& parts) {
  const Image image = read_image(only_picture(eyes, file));
  const Positions positions = eyes.fitted_to(base);
  for (const bool right : {true, false}) {
    std::vector<bool> kept;
    for (Index f = 0; f < eyes.topology.face_count(); ++f) {
      double x = 0;
      for (const std::uint32_t v : eyes.topology.face(f)) x += positions(v, 0);
      kept.push_back((x < 0) == right && !is_clear(image, eyes, f));
    }
    if (std::ranges::count(kept, true) == 0) {
      refuse_file(file, concat("expected an eyeball on either side, found none on the ",
                               right ? "right" : "left"));
    }
    parts.fitted_parts.push_back({right ? "eyeball_r" : "eyeball_l", eyes});
    parts.fitted_parts.back().mesh.keep_faces(kept);
  }
}

struct Wearable {
  std::string_view name, folder, kind, tags;
  double share = 1;
  bool young = false;        ///< whether old people never wear the attachment
  bool is_mirrored = false;  ///< whether left and right of the package's mesh are exchanged
  /// Height at which hair is cut, in centimetres above the eyes; −∞: not cut.
  double end = -HUGE_VAL;
};
// For hair, the tags "male" and "female" come from the package. For brows, the thickness of the
// brows determines these tags.
constexpr auto kWearables = std::to_array<Wearable>({
    {"eyebrow001", "eyebrow001", "brow", "male"},
    {"eyebrow002", "eyebrow002", "brow", "female"},
    {"eyebrow003", "eyebrow003", "brow", "male"},
    {"eyebrow004", "eyebrow004", "brow", "male"},
    {"eyebrow005", "eyebrow005", "brow", "female"},
    {"eyebrow006", "eyebrow006", "brow", "female"},
    {"eyebrow007", "eyebrow007", "brow", "female"},
    {"eyebrow008", "eyebrow008", "brow", "male"},
    {"eyebrow009", "eyebrow009", "brow", "male", 0.4},
    {"eyebrow010", "eyebrow010", "brow", "female"},
    {"eyebrow011", "eyebrow011", "brow", ""},
    {"eyebrow012", "eyebrow012", "brow", "male", 0.4},
    {"lashes_short", "Eyelashes01", "lashes", "male"},
    {"lashes_long", "eyelashes02", "lashes", "female"},
    {"lashes_dense", "eyelashes03", "lashes", "female", 2},
    {"afro01", "afro01", "hair", "african"},
    {"bob01", "bob01", "hair", "female"},
    {"bob01_left", "bob01", "hair", "female", 1, false, true},
    {"bob02", "bob02", "hair", "female"},
    {"bob02_left", "bob02", "hair", "female", 1, false, true},
    {"braid01", "Braid01", "hair", "female", 1, false, false, -12},
    {"braid01_left", "Braid01", "hair", "female", 1, false, true, -12},
    {"long01", "long01", "hair", "female", 1, true},
    {"shoulder01", "long01", "hair", "female", 1, false, false, -11},
    {"chin01", "long01", "hair", "female", 1, false, false, -8},
    {"ponytail01", "ponytail01", "hair", "female", 0.4, true},
    {"short01", "short01", "hair", "male"},
    {"short02", "short02", "hair", "male"},
    {"short02_left", "short02", "hair", "male", 1, false, true},
    {"short03", "short03", "hair", "female", 0.3, true},
    {"short03_left", "short03", "hair", "female", 0.3, true, true},
    {"short04", "short04", "hair", "male"},
    {"full_beard", "Full_beard", "beard", "male"},
    {"moustache", "Moustache", "beard", "male"},
});

struct HairShare {
  std::string_view name;
  /// probabilities of this hair colour for people of African, Asian and Caucasian ancestry
  std::array<double, 3> share;
};
constexpr auto kHairShares = std::to_array<HairShare>({{"black", {0.9, 0.8, 0.06}},
                                                       {"dark_brown", {0.1, 0.2, 0.3}},
                                                       {"brown", {0, 0, 0.28}},
                                                       {"light_brown", {0, 0, 0.18}},
                                                       {"blond", {0, 0, 0.12}},
                                                       {"red", {0, 0, 0.04}},
                                                       {"auburn", {0, 0, 0.02}}});

}  // namespace

std::vector<MakeHumanAttachment> makehuman_attachments(const fs::path& package) {
  std::vector<MakeHumanAttachment> out;
  for (const Wearable& wearable : kWearables) {
    const std::string_view folder = wearable.kind == "brow"     ? "eyebrows"
                                    : wearable.kind == "lashes" ? "eyelashes"
                                                                : "hair";
    out.push_back({std::string(wearable.name), std::string(wearable.kind),
                   proxy(package, folder, wearable.folder), words_of(std::string(wearable.tags)),
                   wearable.young, wearable.share, wearable.is_mirrored, wearable.end});
  }
  return out;
}

/// Returns the shares of ancestry from which the colours of hair and eyes are drawn. The Caucasian
/// share is reduced unless it is above 0.8, because light colours are recessive.
std::array<double, 3> ancestry_of_colours(const MakeHumanPerson& person) {
  std::array<double, 3> shares = person.ancestry;
  shares[2] *= std::clamp((person.ancestry[2] - 0.5) / 0.3, 0.0, 1.0);
  const double sum = shares[0] + shares[1] + shares[2];
  for (double& share : shares) share /= sum;
  return shares;
}

std::string makehuman_hair_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                  std::uint64_t index) {
  double left = random_uniform({seed, index, "makehuman/hair"});
  const std::array<double, 3> ancestry = ancestry_of_colours(person);
  for (const HairShare& colour : kHairShares) {
    for (std::size_t a = 0; a < 3; ++a) left -= ancestry[a] * colour.share[a];
    if (left < 0) return std::string(colour.name);
  }
  return std::string(kHairShares[0].name);
}

std::string prevailing_ancestry(const MakeHumanPerson& person) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (person.ancestry[a] > 0.5) return std::string(kAncestries[a]);
  }
  return {};
}

std::vector<WeightedSkin> makehuman_skin_shares(const fs::path& package,
                                                const MakeHumanPerson& person, std::uint64_t seed,
                                                std::uint64_t index) {
  std::vector<WeightedSkin> out;
  const std::string_view sex = person.is_male ? "male" : "female";
  for (const AgeShare& age : age_shares(person.age_years)) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double share = age.share * person.ancestry[a];
      if (share == 0) continue;
      const std::string folder = concat(age.name, '_', kAncestries[a], '_', sex);
      // The package has two skins for each sex of young Caucasians, and one skin for each other
      // combination of age, ancestry and sex.
      const bool second = folder.starts_with("young_caucasian") &&
                          random_uniform({seed, index, "makehuman/skin"}) < 0.5;
      out.push_back({skin_picture(package / "public/data/skins" / folder /
                                  concat(folder, second ? "2" : "", ".json")),
                     share});
    }
  }
  return out;
}

double makehuman_skin_optical_density_factor(const MakeHumanPerson& person, std::uint64_t seed,
                                             std::uint64_t index) {
  // Women's skin is lighter than men's (Jablonski and Chaplin 2000, "The evolution of human skin
  // coloration"). The package's skins of old people are too dark.
  const double mean = (person.is_male ? 1.02 : 0.88) - 0.18 * age_shares(person.age_years)[2].share;
  return std::clamp(mean + 0.1 * random_normal({seed, index, "makehuman/tone"}), 0.6, 1.25);
}

double makehuman_skin_detail_factor(const MakeHumanPerson& person) {
  const auto shares = age_shares(person.age_years);
  return 1 + (person.is_male ? 1.2 : 1.7) * shares[1].share +
         (person.is_male ? 1.2 : 1.0) * shares[2].share;
}

std::array<double, 3> makehuman_lip_tint(const MakeHumanPerson& person, std::uint64_t seed,
                                         std::uint64_t index) {
  if (person.is_male) return {1, 1, 1};
  const auto drawn = random_pair({seed, index, "makehuman/lips"});
  const bool lipstick = drawn[0] < 1.0 / 3;
  const double strength = lipstick ? 0.6 + 0.6 * drawn[1] : 0.3 + 0.2 * drawn[1];
  constexpr std::array<double, 3> kDensities = {0.1, 1, 0.75};
  std::array<double, 3> tint{};
  for (std::size_t c = 0; c < 3; ++c) tint[c] = std::exp(-strength * kDensities[c]);
  return tint;
}

std::string makehuman_eye_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                 std::uint64_t index) {
  double left = random_uniform({seed, index, "makehuman/eyes"});
  const std::array<double, 3> ancestry = ancestry_of_colours(person);
  for (const EyeColour& colour : kEyeColours) {
    for (std::size_t a = 0; a < 3; ++a) left -= ancestry[a] * colour.share[a];
    if (left < 0) return std::string(colour.name);
  }
  return std::string(kEyeColours[0].name);
}

IrisLook makehuman_iris_look(const std::string& colour) {
  return eye_colour(colour).look;
}

MakeHumanParts read_makehuman_parts(const fs::path& package, const Positions& base) {
  MakeHumanParts parts;
  const fs::path eyes_file = proxy(package, "eyes", "HighPolyEyes");
  const FittedMesh eyes = read_free(eyes_file, base.rows());
  add_eyeballs(eyes, eyes_file, base, parts);
  parts.eye_colours = eyes.pictures;
  parts.eyes_licence = eyes.licence;
  for (const EyeColour& colour : kEyeColours) {
    if (std::ranges::none_of(eyes.pictures, [&](const FittedMesh::Picture& picture) {
          return picture.name == colour.look.picture && !picture.path.empty();
        })) {
      refuse_file(eyes_file, concat("expected a picture of ", colour.name, " eyes, found none"));
    }
  }
  const auto add = [&](std::string_view kind, std::string_view name, const char* material,
                       fs::path& picture, AssetLicence& licence) {
    const fs::path file = proxy(package, kind, name);
    FittedMesh mesh = read_free(file, base.rows());
    picture = only_picture(mesh, file);
    licence = mesh.licence;
    parts.fitted_parts.push_back({material, std::move(mesh)});
  };
  add("teeth", "Teeth_Base", "teeth", parts.teeth, parts.teeth_licence);
  add("tongue", "tongue01", "tongue", parts.tongue, parts.tongue_licence);
  return parts;
}

}  // namespace crowdface

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
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

struct AgeShare {
  std::string_view name;
  double share;
};

/// Returns the blending weights of the package's skins for a person's age. The skins show people of
/// 27, 48 and 68 years. The weights are interpolated linearly between these ages.
std::array<AgeShare, 3> age_shares(double years) {
  const double middle = std::clamp((years - 27) / (48 - 27), 0.0, 1.0);
  const double old = std::clamp((years - 48) / (68 - 48), 0.0, 1.0);
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
  std::array<double, 3> share;  ///< probabilities for African, Asian and Caucasian ancestry
};
constexpr auto kEyeColours = std::to_array<EyeColour>({{"brown", {0.9, 0.85, 0.25}},
                                                       {"brownlight", {0.1, 0.15, 0.25}},
                                                       {"green", {0, 0, 0.15}},
                                                       {"grey", {0, 0, 0.17}},
                                                       {"blue", {0, 0, 0.18}}});

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
  std::string_view folder, kind, tags;
  double share = 1;
  bool young = false;  ///< whether old people never wear the attachment
};
// For hair, the tags "male" and "female" come from the package. For brows, the thickness of the
// brows determines these tags.
constexpr auto kWearables = std::to_array<Wearable>({{"eyebrow001", "brow", "male"},
                                                     {"eyebrow002", "brow", "female"},
                                                     {"eyebrow003", "brow", "male"},
                                                     {"eyebrow004", "brow", "male"},
                                                     {"eyebrow005", "brow", "female"},
                                                     {"eyebrow006", "brow", "female"},
                                                     {"eyebrow007", "brow", "female"},
                                                     {"eyebrow008", "brow", "male"},
                                                     {"eyebrow009", "brow", "male", 0.4},
                                                     {"eyebrow010", "brow", "female"},
                                                     {"eyebrow011", "brow", ""},
                                                     {"eyebrow012", "brow", "male", 0.4},
                                                     {"afro01", "hair", "african", 3},
                                                     {"bob01", "hair", "female"},
                                                     {"bob02", "hair", "female"},
                                                     {"Braid01", "hair", "female"},
                                                     {"long01", "hair", "female", 1, true},
                                                     {"ponytail01", "hair", "female"},
                                                     {"short01", "hair", "male"},
                                                     {"short02", "hair", "male"},
                                                     {"short03", "hair", "female"},
                                                     {"short04", "hair", "male"},
                                                     {"Full_beard", "beard", "male"},
                                                     {"Moustache", "beard", "male"}});

struct HairShare {
  std::string_view name;
  std::array<double, 3> share;  ///< probabilities for African, Asian and Caucasian ancestry
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
    const bool brow = wearable.kind == "brow";
    out.push_back({lower_case(wearable.folder), std::string(wearable.kind),
                   proxy(package, brow ? "eyebrows" : "hair", wearable.folder),
                   words_of(std::string(wearable.tags)), wearable.young, wearable.share});
  }
  return out;
}

std::string makehuman_hair_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                  std::uint64_t index) {
  double left = random_uniform({seed, index, "makehuman/hair"});
  for (const HairShare& colour : kHairShares) {
    for (std::size_t a = 0; a < 3; ++a) left -= person.ancestry[a] * colour.share[a];
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

double makehuman_skin_optical_density_factor(std::uint64_t seed, std::uint64_t index) {
  return std::clamp(1 + 0.1 * random_normal({seed, index, "makehuman/tone"}), 0.75, 1.25);
}

std::string makehuman_eye_colour(const MakeHumanPerson& person, std::uint64_t seed,
                                 std::uint64_t index) {
  double left = random_uniform({seed, index, "makehuman/eyes"});
  for (const EyeColour& colour : kEyeColours) {
    for (std::size_t a = 0; a < 3; ++a) left -= person.ancestry[a] * colour.share[a];
    if (left < 0) return std::string(colour.name);
  }
  return std::string(kEyeColours[0].name);
}

MakeHumanParts read_makehuman_parts(const fs::path& package, const Positions& base,
                                    const std::vector<std::uint32_t>& skin) {
  MakeHumanParts parts;
  const fs::path eyes_file = proxy(package, "eyes", "HighPolyEyes");
  const FittedMesh eyes = read_free(eyes_file, base.rows());
  add_eyeballs(eyes, eyes_file, base, parts);
  parts.eye_colours = eyes.pictures;
  parts.eyes_licence = eyes.licence;
  for (const EyeColour& colour : kEyeColours) {
    if (std::ranges::none_of(eyes.pictures, [&](const FittedMesh::Picture& picture) {
          return picture.name == colour.name && !picture.path.empty();
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
  add("eyelashes", "Eyelashes01", "eyelashes", parts.lashes, parts.lashes_licence);
  parts.fitted_parts.back().mesh.anchor_to(skin, base);
  add("teeth", "Teeth_Base", "teeth", parts.teeth, parts.teeth_licence);
  add("tongue", "tongue01", "tongue", parts.tongue, parts.tongue_licence);
  return parts;
}

}  // namespace crowdface

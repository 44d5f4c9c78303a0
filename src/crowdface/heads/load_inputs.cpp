// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/load_inputs.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/alignment_check.h"
#include "crowdface/heads/expression_check.h"
#include "crowdface/heads/find_levels.h"
#include "crowdface/heads/head_checks.h"
#include "crowdface/heads/head_mirror.h"
#include "crowdface/heads/load_transferred.h"
#include "crowdface/heads/mask_checks.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/heads/read_heads.h"
#include "crowdface/heads/shared_by_heads.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

/// Reads the vertex colours of the heads, if any head has them.
void read_vertex_colours(Inputs& inputs) {
  const std::size_t count = inputs.head_files.size();
  std::vector<ColourRows> colours(count);
  parallel_for_each(count, [&](std::size_t h) {
    colours[h] =
        obj_colours(inputs.head_files[h].file.bytes(), inputs.head_set.heads[h].positions.rows());
  });
  const auto has_none = [](const ColourRows& rows) { return rows.rows() == 0; };
  if (std::ranges::all_of(colours, has_none)) return;
  std::vector<std::string> without;
  Hasher hasher;
  for (std::size_t h = 0; h < count; ++h) {
    hasher.add_array(numbers_of(colours[h]));
    if (has_none(colours[h])) without.push_back(inputs.head_set.heads[h].name);
  }
  inputs.colours_digest = hasher.digest();
  inputs.vertex_colours = std::move(colours);
  if (without.empty()) return;
  inputs.warn(concat(join(without),
                     ": no vertex colours, although other heads have them; faces take the colours "
                     "of their other heads"));
}

/// Moves the heads into the inputs; their common topology is stored once.
void take_heads(const Config& config, std::vector<HeadFile> heads, Inputs& inputs) {
  for (std::size_t h = 0; h < heads.size(); ++h) {
    ObjFile& file = heads[h].file;
    file.corner_normals = heads[h].mesh->corner_normals;
    inputs.head_set.heads.push_back({config.faces.names[h], std::move(file.positions)});
    inputs.head_files.push_back(std::move(file));
    inputs.head_file_digests.push_back(heads[h].text_digest);
  }
  inputs.head_set.topology = std::move(heads[0].mesh->topology);
  inputs.head_set.uvs = std::move(heads[0].mesh->uvs);
}

double mean_edge_length_mm(const Config& config, const Inputs& inputs) {
  const std::uint32_t skin = inputs.components.largest();
  const std::vector<Head>& heads = inputs.head_set.heads;
  std::vector<double> lengths(heads.size());
  parallel_for_each(heads.size(), [&](std::size_t h) {
    lengths[h] = rms_edge_length(inputs.adjacency, inputs.components, skin, heads[h].positions);
  });
  const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  return sum / static_cast<double>(heads.size()) * mm_per(config.faces.units);
}

/// Returns a warning if output.surfaces names materials that no polygon has.
std::optional<std::string> unknown_surfaces_warning(const Config& config, const Inputs& inputs) {
  const std::vector<std::string>& known = inputs.materials.names;
  std::vector<std::string> unknown, materials;
  for (const auto& [name, surface] : config.output.surfaces) {
    if (std::ranges::find(known, name) == known.end()) unknown.push_back(quoted(name));
  }
  if (unknown.empty()) return std::nullopt;
  for (const std::string& name : known) {
    if (!name.empty()) materials.push_back(quoted(name));
  }
  return concat("output.surfaces names ", join(unknown), ", but no polygon of ",
                config.faces.files.front().string(), " has such a material; ",
                materials.empty() ? "its polygons name no materials (usemtl)"
                                  : concat("its materials are ", join(materials)));
}

std::uint64_t max_level_of(const Config& config, double edge_length_mm) {
  if (config.smoothing.max_iterations) return *config.smoothing.max_iterations;
  const std::uint64_t level = iterations_for_wavelength(
      config.smoothing.operator_kind, config.smoothing.max_size_mm, edge_length_mm);
  return std::max<std::uint64_t>(level, 1);
}

Digest digest_of_topology(const Topology& topology) {
  return Hasher()
      .add(topology.vertex_count)
      .add_array(std::span(topology.corner_vertices))
      .add_array(std::span(topology.face_offsets))
      .digest();
}

std::vector<Digest> hash_heads(const HeadSet& heads) {
  std::vector<Digest> digests(heads.heads.size());
  parallel_for_each(digests.size(), [&](std::size_t h) {
    digests[h] = Hasher().add_array(numbers_of(heads.heads[h].positions)).digest();
  });
  return digests;
}

/// Returns a warning that a texture is not blended because some heads lack it; nothing if all or no
/// heads have a texture. Call only if all heads with a texture have the same texture files.
std::optional<std::string> single_texture_warning(const FoundTextureFiles& textures,
                                                  const HeadSet& heads) {
  std::vector<std::string> with, without;
  for (std::size_t h = 0; h < textures.heads.size(); ++h) {
    (textures.heads[h].files.empty() ? without : with).push_back(heads.heads[h].name);
  }
  if (with.empty() || without.empty()) return std::nullopt;
  return concat("the ", mtl_statement_of(textures.kind).name, " texture of ", join(with),
                " is not blended, because the other heads have none (", join(without),
                "); only faces with such a target get it, unchanged");
}

/// Loads textures. After each damaged image, loads again as if that file were missing.
/// \param load  called with the textures found; returns the loaded textures, or throws DamagedImage
template <class Load>
HeadTextures load_undamaged(FoundTextureFiles& found, Inputs& inputs, const Load& load) {
  // For each damaged file, the message about the damage. The map is sorted, so that the order of
  // the messages is fixed.
  std::map<std::filesystem::path, std::string> damaged;
  for (;;) {
    try {
      HeadTextures loaded = load(found);
      for (const auto& [file, why] : damaged) {
        inputs.warn(concat(why, "; the texture is neither blended nor shown"));
      }
      return loaded;
    } catch (const DamagedImage& error) {
      damaged.emplace(error.path, error.what());
      leave_out_files(found, {error.path});
    }
  }
}

void read_textures(const Config& config, const CacheFolder& cache, Inputs& inputs,
                   Problems& problems) {
  const auto& sheet = config.output.contact_sheet;
  const bool shown = (sheet && sheet->texture != SheetTexture::kNo) || inputs.heads_on_body;
  const bool blend =
      config.textures.blend == TextureBlend::kAuto && (shown || !config.output.meshes.empty());
  if (config.textures.blend == TextureBlend::kNone || !(shown || blend)) return;
  try {
    std::vector<FoundTextureFiles> kinds = find_texture_files(inputs.head_set, inputs.head_files);
    FoundTextureFiles& found = kinds.front();
    const bool asked_for = sheet && sheet->texture == SheetTexture::kYes;
    if (asked_for && !found.has_files()) {
      throw MissingInput(
          concat(config.faces.files.front().string(),
                 ": output.contact_sheet.texture is true, but no head has texture coordinates and "
                 "a material with an existing texture (map_Kd in the mtllib file)"));
    }
    if (!asked_for) {
      for (std::string& text : leave_out_unreadable_files(found)) inputs.warn(std::move(text));
    }
    const auto load_blended = [&](const FoundTextureFiles& textures) {
      return load_blended_textures(inputs.head_set, inputs.materials, textures,
                                   config.textures.size, cache);
    };
    const auto load_colours = [&](const FoundTextureFiles& textures) {
      if (textures.has_files() && blend && textures.heads_have_different_textures())
        return load_blended(textures);
      if (textures.has_files() && shown)
        return load_render_textures(textures,
                                    max_rendered_texels(sheet.value_or(Config::ContactSheet{})));
      HeadTextures none;
      if (!textures.has_files()) none.warnings = textures.warnings;
      return none;
    };
    inputs.textures = asked_for ? load_colours(found) : load_undamaged(found, inputs, load_colours);
    for (const std::string& text : inputs.textures.warnings) inputs.warn(text);
    for (std::size_t k = 1; blend && k < kinds.size(); ++k) {
      const bool pictured = shown && is_shown_in_previews(kinds[k].kind);
      if (!pictured && config.output.meshes.empty()) continue;
      for (std::string& text : leave_out_unreadable_files(kinds[k])) inputs.warn(std::move(text));
      HeadTextures maps = load_undamaged(kinds[k], inputs, [&](const FoundTextureFiles& textures) {
        return textures.heads_have_different_textures() ? load_blended(textures) : HeadTextures();
      });
      if (!kinds[k].heads_have_different_textures()) {
        if (auto text = single_texture_warning(kinds[k], inputs.head_set))
          inputs.warn(std::move(*text));
        continue;
      }
      inputs.other_textures.push_back(std::move(maps));
      for (const std::string& text : inputs.other_textures.back().warnings) inputs.warn(text);
    }
  } catch (const RecoverableError& error) {
    problems.add(error);
  }
}

}  // namespace

void Inputs::warn(std::string text) {
  log_warning(text);
  warnings.push_back(std::move(text));
}

void check_inputs(const ConfigReading& reading, const CacheFolder& cache, Problems& problems) {
  // The config reader has already reported missing files.
  const auto is_missing = [](const std::filesystem::path& file) { return !path_exists(file); };
  if (reading.are_heads_known) {
    std::vector<std::filesystem::path> heads = reading.config.faces.files;
    std::erase_if(heads, is_missing);
    compare_meshes(read_heads(heads, cache, problems), problems);
  }
  if (reading.are_regions_known) {
    std::vector<std::string> masks = reading.config.regions.mask;
    std::erase_if(masks, is_missing);
    check_masks(masks, problems);
  }
}

std::optional<HeadSet> load_head_set(const Config::Faces& faces, const CacheFolder& cache,
                                     Problems& problems) {
  const std::size_t before = problems.size();
  std::vector<HeadFile> heads = read_heads(faces.files, cache, problems);
  compare_meshes(heads, problems);
  if (problems.size() > before) return std::nullopt;
  HeadSet set;
  set.topology = heads[0].mesh->topology;
  set.uvs = heads[0].mesh->uvs;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    set.heads.push_back({faces.names[h], std::move(heads[h].file.positions)});
  }
  return set;
}

std::optional<Inputs> load_inputs(const Config& config, const CacheFolder& cache,
                                  Problems& problems) {
  std::vector<HeadFile> heads = read_heads(config.faces.files, cache, problems);
  compare_meshes(heads, problems);
  if (!problems.empty()) {
    check_masks(config.regions.mask, problems);
    return std::nullopt;
  }

  cache_heads(heads, cache);
  Inputs inputs;
  for (std::string& text : few_decimals_warnings(heads, mm_per(config.faces.units))) {
    inputs.warn(std::move(text));
  }
  take_heads(config, std::move(heads), inputs);
  read_vertex_colours(inputs);
  inputs.materials =
      polygon_materials(inputs.head_files[0].materials, inputs.head_set.topology.face_count());
  inputs.cache = cache;
  inputs.topology_digest = digest_of_topology(inputs.head_set.topology);
  find_neighbours(inputs);
  try {
    for (std::string& text : align_heads(inputs.head_set, inputs.components, config.faces.align)) {
      inputs.warn(std::move(text));
    }
  } catch (const RecoverableError& error) {
    problems.add(error);
    return std::nullopt;
  }
  inputs.head_digests_before_placement = hash_heads(inputs.head_set);
  load_neck(config, inputs, problems);
  if (!problems.empty()) return std::nullopt;
  inputs.head_digests =
      inputs.heads_on_body ? hash_heads(inputs.head_set) : inputs.head_digests_before_placement;
  inputs.mean_head = mean_head(inputs.head_set);
  const std::size_t before = problems.size();
  find_named_parts(config, inputs, problems);
  std::vector<std::string> odd_expressions;
  BackgroundTasks beside;
  beside.run([&] {
    odd_expressions =
        odd_expression_warnings(inputs.head_set, skin_of(inputs),
                                axes_of(Orientation{config.faces.up, config.faces.front}));
  });
  try {
    if (auto text = check_orientation_and_size(config, inputs)) inputs.warn(std::move(*text));
    const std::string key = mirroring_key(config);
    if (!key.empty()) inputs.mirror_map = required_mirror_map(config, inputs, key);
  } catch (const RecoverableError& error) {
    problems.add(error);
  }
  if (problems.size() > before) return std::nullopt;
  for (std::string& text : single_image_mask_warnings(config, inputs)) inputs.warn(std::move(text));
  if (auto text = far_from_origin_warning(config, inputs)) inputs.warn(std::move(*text));
  for (std::string& text : same_person_warnings(inputs, mm_per(config.faces.units))) {
    inputs.warn(std::move(text));
  }
  beside.wait();
  for (std::string& text : odd_expressions) inputs.warn(std::move(text));
  if (auto text = unknown_surfaces_warning(config, inputs)) inputs.warn(std::move(*text));
  inputs.edge_length_mm = mean_edge_length_mm(config, inputs);
  try {
    inputs.regions = load_regions(config, inputs);
    if (config.distance.mask) {
      inputs.distance_weights = mask_values(inputs.head_set.topology, inputs.head_set.uvs,
                                            MaskSource(*config.distance.mask), skin_of(inputs),
                                            inputs.head_files[0].path.string());
    }
    inputs.max_level = max_level_of(config, inputs.edge_length_mm);
  } catch (const RecoverableError& error) {
    problems.add(error);
    return std::nullopt;
  }
  if (inputs.regions.uncovered_vertex_count > 0) {
    inputs.warn(concat(inputs.regions.uncovered_vertex_count,
                       " vertices are covered by no mask and belong to the last region, ",
                       config.region_names().back()));
  }
  for (std::string& text : ineffective_mask_warnings(config, inputs)) inputs.warn(std::move(text));
  inputs.mask_digest = Hasher().add_array(numbers_of(inputs.regions.alpha)).digest();
  read_textures(config, cache, inputs, problems);
  if (!config.neck.body_texture.empty() && inputs.vertex_colours.empty() &&
      !inputs.textures.has_textures()) {
    problems.add(ExitCode::kUsage, concat(config.file.string(),
                                          ": neck.body_texture: the heads have neither textures "
                                          "nor vertex colours to which the body can be tinted"));
  }
  load_shapes(config, cache, inputs, problems);
  load_points(config, inputs, problems);
  load_rig(config, inputs, problems);
  load_attachments(config, cache, inputs, problems);
  if (problems.size() > before) return std::nullopt;
  find_levels(config, cache, inputs);
  return inputs;
}

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/load_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
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
#include "crowdface/heads/head_mirror.h"
#include "crowdface/heads/load_carried.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/heads/read_heads.h"
#include "crowdface/heads/shared_by_heads.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/region/vertex_weights.h"
#include "crowdface/smooth/level_size.h"

namespace crowdface {
namespace {

constexpr double kUvTolerance = 1e-4;

/// Opens the mask images as far as that goes without texture coordinates, which alone tell the UDIM
/// tiles in use.
void check_masks(const std::vector<std::string>& files, Problems& problems) {
  for (const std::string& file : files) {
    const MaskSource mask(file);
    if (mask.tiled()) continue;
    try {
      if (holds_vertex_weights(file)) {
        read_vertex_weights(file);
      } else {
        mask.read(0);
      }
    } catch (const RecoverableError& error) {
      problems.add(error);
    }
  }
}

/// The first corner that has another place in the texture, whatever rows the places stand in: programs
/// number them anew when they write a file. Empty if there is none.
std::string first_uv_difference(const HeadMesh& expected, const HeadMesh& found) {
  const auto text = [](const TextureCoordinates& uvs, std::uint32_t row) {
    return row == kNoIndex ? std::string("none") : concat(uvs(row, 0), ' ', uvs(row, 1));
  };
  for (Index f = 0; f < expected.topology.face_count(); ++f) {
    const auto [begin, end] = expected.topology.corners(f);
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t a =
          expected.topology.corner_uvs.empty() ? kNoIndex : expected.topology.corner_uvs[c];
      const std::uint32_t b =
          found.topology.corner_uvs.empty() ? kNoIndex : found.topology.corner_uvs[c];
      if (a == kNoIndex && b == kNoIndex) continue;
      if (a != kNoIndex && b != kNoIndex &&
          (expected.uvs.row(a) - found.uvs.row(b)).cwiseAbs().maxCoeff() <= kUvTolerance) {
        continue;
      }
      return concat("face ", f + 1, ", corner ", c - begin + 1,
                    ": expected the texture coordinate ", text(expected.uvs, a), ", found ",
                    text(found.uvs, b));
    }
  }
  return {};
}

/// What an export did to a head that has another topology than the first, and what helps.
std::string cause_of_difference(const Topology& first, const Topology& found) {
  const auto triangles = [](const Topology& topology) {
    return topology.corner_count() - 2 * topology.face_count();
  };
  const bool same_vertices = first.vertex_count == found.vertex_count;
  const bool same_faces = first.face_count() == found.face_count();
  if (same_vertices && same_faces) {
    return "; it has as many vertices and faces, in another order or otherwise connected: export "
           "it again with the order "
           "of vertices kept, or wrap the first head onto it (crowdface wrap)";
  }
  if (same_vertices && triangles(first) == triangles(found)) {
    return found.face_count() > first.face_count()
               ? "; its polygons were cut into triangles: export it without triangulating"
               : "; its triangles were joined to polygons: export it as the others were";
  }
  if (triangles(first) == triangles(found)) {
    return found.vertex_count > first.vertex_count
               ? "; its vertices were split, at texture seams or hard edges: export it with "
                 "vertices shared"
               : "; some of its vertices were joined: export it without welding or merging";
  }
  return concat("; it has ", found.vertex_count, " vertices and ", found.face_count(),
                " faces, the first ", first.vertex_count, " and ", first.face_count(),
                ": another mesh, onto which crowdface wrap brings the first head's");
}

void compare_with_first(const std::vector<HeadFile>& heads, Problems& problems) {
  for (const HeadFile& head : heads) {
    if (head.mesh == heads[0].mesh) continue;
    const HeadMesh &first = *heads[0].mesh, &mesh = *head.mesh;
    std::string difference = first_difference(first.topology, mesh.topology);
    if (!difference.empty()) {
      difference += cause_of_difference(first.topology, mesh.topology);
    } else {
      difference = first_uv_difference(first, mesh);
    }
    if (difference.empty()) continue;
    problems.add(ExitCode::kBadData, concat(head.file.path.string(), ": not the same mesh as ",
                                            heads[0].file.path.string(), ": ", difference));
  }
}

/// Colours at the heads' vertices, if any head has them.
void take_colours(Inputs& inputs) {
  const std::size_t count = inputs.files.size();
  std::vector<ColourRows> colours(count);
  parallel_for_each(count, [&](std::size_t h) {
    colours[h] = obj_colours(inputs.files[h].file.bytes(), inputs.faces.heads[h].positions.rows());
  });
  const auto has_none = [](const ColourRows& rows) { return rows.rows() == 0; };
  if (std::ranges::all_of(colours, has_none)) return;
  std::vector<std::string> without;
  Hasher hasher;
  for (std::size_t h = 0; h < count; ++h) {
    hasher.add_array(numbers_of(colours[h]));
    if (has_none(colours[h])) without.push_back(inputs.faces.heads[h].name);
  }
  inputs.colours_digest = hasher.digest();
  inputs.colours = std::move(colours);
  if (without.empty()) return;
  inputs.warn(concat(join(without),
                     ": no colours at vertices, which other heads have; faces have "
                     "those of their other heads"));
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

/// \throws InvalidInput if the heads look another way than the config says, or are of a size that no
/// heads have: then everything that is measured would be wrong.
void check_stance(const Config& config, const Inputs& inputs) {
  if (config.faces.align == Align::kNone) return;
  const HeadShape head{inputs.mean, skin_of(inputs), {}};  // parts that follow are no skin
  const Topology& topology = inputs.faces.topology;
  const Bearing asked{config.faces.up, config.faces.front};
  auto marks = find_face_marks(topology, head, axes_of(asked));
  if (!marks) {
    const auto found = find_bearing(topology, head);
    if (!found) return;
    throw InvalidInput(concat(
        "the heads look along ", name_of(found->front), " with ", name_of(found->up),
        " up, and not as faces.front ", name_of(asked.front), " and faces.up ", name_of(asked.up),
        " say: set up: ", name_of(found->up), " and front: ", name_of(found->front),
        " (faces.align: none takes them as they are)"));
  }
  constexpr double kLeastMm = 35, kMostMm = 120;  // of people, from a child's 45 mm to some 85
  const double mm = marks->face() * mm_per(config.faces.units);
  if (mm >= kLeastMm && mm <= kMostMm) return;
  const auto up = inputs.faces.heads[0].positions.col(config.faces.up.index);
  const double units = up.maxCoeff() - up.minCoeff();
  constexpr double kTypicalMm = 65;
  LengthUnit fitting = fitting_unit(marks->face(), kTypicalMm);
  for (const LengthUnit unit : kLengthUnits) {
    const double other = marks->face() * mm_per(unit);
    if (other >= kLeastMm && other <= kMostMm) fitting = unit;
  }
  throw InvalidInput(concat(
      "the first head is ", format_fixed(units, 2), " units high, with faces.units ",
      name_of(config.faces.units), " ", format_fixed(units * mm_per(config.faces.units) / 10, 1),
      " cm, and ", format_fixed(mm, 0),
      " mm from the eyes to the mouth; of people that is some 65 mm: set units: ", name_of(fitting),
      " (faces.align: none takes any size)"));
}

/// A warning for each mask that is one image where the skin lies in several tiles.
std::vector<std::string> lone_masks(const Config& config, const Inputs& inputs) {
  std::set<std::pair<double, double>> tiles;
  const Topology& topology = inputs.faces.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto uvs = topology.face_uvs(f);
    if (uvs.empty() || inputs.skin.of_vertex[topology.face(f)[0]] != inputs.skin.largest())
      continue;
    Eigen::RowVector2d middle(0, 0);
    for (const std::uint32_t uv : uvs) {
      if (uv != kNoIndex) {
        middle += inputs.faces.uvs.row(uv) / static_cast<double>(uvs.size());
      }
    }
    tiles.emplace(std::floor(middle.x()), std::floor(middle.y()));
  }
  std::vector<std::string> warnings;
  for (const std::string& mask : config.regions.mask) {
    if (tiles.size() < 2 || MaskSource(mask).tiled() || holds_vertex_weights(mask)) continue;
    warnings.push_back(concat("mask ", mask, " is one image, but the skin's texture has ",
                              tiles.size(),
                              " tiles: beyond the first its edge goes on; with <UDIM> "
                              "in its name each tile has an image of its own"));
  }
  return warnings;
}

/// A warning for each two heads that are one person's, as far as their shapes tell.
std::vector<std::string> same_persons(const Inputs& inputs, double mm) {
  constexpr Index kSamples = 2000;
  constexpr double kMostMm = 1,
                   kMostOfOthers = 0.4;  // of the middle distance to the most alike head
  const std::vector<Head>& heads = inputs.faces.heads;
  std::vector<Positions> sampled(heads.size());
  std::vector<Index> rows;
  for (Index v = 0; v < inputs.mean.rows(); ++v) {
    if (inputs.skin.of_vertex[static_cast<std::size_t>(v)] == inputs.skin.largest())
      rows.push_back(v);
  }
  const std::size_t step =
      std::max<std::size_t>(1, rows.size() / static_cast<std::size_t>(kSamples));
  std::vector<Index> some;
  for (std::size_t i = 0; i < rows.size(); i += step) some.push_back(rows[i]);
  if (some.size() < 3) return {};
  const auto distance = [&](std::size_t a, std::size_t b) {
    const Positions from = heads[a].positions(some, kAllColumns),
                    to = heads[b].positions(some, kAllColumns);
    const Positions moved = fit_similarity(from, to, ScaleFit::kRigid).apply(from);
    return mm * std::sqrt((moved - to).rowwise().squaredNorm().mean());
  };
  std::vector<std::vector<double>> apart(heads.size(), std::vector<double>(heads.size(), 0));
  parallel_for_each(heads.size(), [&](std::size_t a) {
    for (std::size_t b = a + 1; b < heads.size(); ++b) apart[a][b] = distance(a, b);
  });
  std::vector<double> nearest;
  for (std::size_t a = 0; a < heads.size(); ++a) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t b = 0; b < heads.size(); ++b) {
      if (b != a) least = std::min(least, apart[std::min(a, b)][std::max(a, b)]);
    }
    nearest.push_back(least);
  }
  std::ranges::sort(nearest);
  const double middle = nearest[nearest.size() / 2];
  std::vector<std::string> warnings;
  for (std::size_t a = 0; a < heads.size(); ++a) {
    for (std::size_t b = a + 1; b < heads.size(); ++b) {
      const double mean = apart[a][b];
      if (mean > kMostMm || (mean > kMostOfOthers * middle && mean > 0)) continue;
      warnings.push_back(concat("heads ", heads[a].name, " and ", heads[b].name, " are ",
                                format_fixed(mean, 2),
                                " mm apart in the mean: is this one person twice? Faces of both "
                                "are less varied than they seem"));
    }
  }
  return warnings;
}

/// Warnings of masks that do not do what masks are for.
std::vector<std::string> odd_masks(const Config& config, const Inputs& inputs) {
  const std::vector<std::string>& names = config.regions.names;
  if (names.empty() || config.regions.mask.empty()) return {};
  if (names.size() == 1) {
    return {
        concat("with one region its mask changes nothing, as what it does not cover goes to the "
               "last region, which "
               "is the same: name a second one, names: [",
               names[0], ", rest], which gets what the first leaves")};
  }
  std::vector<std::string> warnings;
  const std::vector<bool> skin = skin_of(inputs);
  bool all_are_everywhere = true;
  for (std::size_t r = 0; r < names.size(); ++r) {
    double least = 1, most = 0;
    for (std::size_t v = 0; v < skin.size(); ++v) {
      if (!skin[v]) continue;
      const double weight = inputs.regions.alpha(static_cast<Index>(v), static_cast<Index>(r));
      least = std::min(least, weight);
      most = std::max(most, weight);
    }
    if (most == 0) {
      warnings.push_back(concat("the region ", names[r],
                                " covers no skin: its mask is black wherever the texture "
                                "coordinates of the skin lie"));
    }
    constexpr double kNothing = 0.02;
    all_are_everywhere = all_are_everywhere && least > kNothing;
  }
  if (all_are_everywhere) {
    warnings.push_back(concat("the masks (", join(config.regions.mask),
                              ") leave no region out anywhere: each vertex of the skin "
                              "belongs to all of ",
                              join(names), "; are they a painting of skin and not masks?"));
  }
  return warnings;
}

/// A warning if output.surfaces names materials that no face has.
std::optional<std::string> unknown_surfaces(const Config& config, const Inputs& inputs) {
  const std::vector<std::string>& known = inputs.materials.names;
  std::vector<std::string> unknown, materials;
  for (const auto& [name, surface] : config.output.surfaces) {
    if (std::ranges::find(known, name) == known.end()) unknown.push_back(quoted(name));
  }
  if (unknown.empty()) return std::nullopt;
  for (const std::string& name : known) {
    if (!name.empty()) materials.push_back(quoted(name));
  }
  return concat("output.surfaces names ", join(unknown), ", which no face of ",
                config.faces.files.front().string(), " is made of; ",
                materials.empty() ? "its faces name no materials (usemtl)"
                                  : concat("its materials are ", join(materials)));
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

Digest digest_of_topology(const Topology& topology) {
  return Hasher()
      .add(topology.vertex_count)
      .add_array(std::span(topology.corner_vertices))
      .add_array(std::span(topology.face_offsets))
      .digest();
}

void hash_heads(Inputs& inputs) {
  inputs.head_digests.resize(inputs.faces.heads.size());
  parallel_for_each(inputs.faces.heads.size(), [&](std::size_t h) {
    const Positions& positions = inputs.faces.heads[h].positions;
    inputs.head_digests[h] = Hasher().add_array(numbers_of(positions)).digest();
  });
}

/// What to say of heads without a map where all others have one and the same: it is not blended.
std::optional<std::string> told_of_single(const HeadsTextures& textures, const FaceSet& faces) {
  std::vector<std::string> with, without;
  for (std::size_t h = 0; h < textures.heads.size(); ++h) {
    (textures.heads[h].files.empty() ? without : with).push_back(faces.heads[h].name);
  }
  if (with.empty() || without.empty()) return std::nullopt;
  return concat("the ", statement_of(textures.kind).name, " texture of ", join(with),
                " is not blended, as all other heads have none (", join(without),
                "): only faces with such a target get it, as it is");
}

/// Does without pictures that turn out to be damaged when they are read: loads again, as if they were not there.
/// \param load  makes what blends of a copy.
template <class Load>
HeadTextures load_sound(HeadsTextures& found, Inputs& inputs, const Load& load) {
  std::map<std::filesystem::path, std::string> damaged;  // told in order, whichever was met first
  for (;;) {
    try {
      HeadTextures loaded = load(found);
      for (const auto& [file, why] : damaged) {
        inputs.warn(concat(why, "; the texture is neither blended nor shown"));
      }
      return loaded;
    } catch (const DamagedImage& error) {
      damaged.emplace(error.path, error.what());
      leave_out(found, {error.path});
    }
  }
}

void read_textures(const Config& config, const CacheFolder& cache, Inputs& inputs,
                   Problems& problems) {
  const auto& sheet = config.output.contact_sheet;
  const bool shown = sheet && sheet->texture != SheetTexture::kNo;
  const bool blend =
      config.textures.blend == TextureBlend::kAuto && (shown || !config.output.meshes.empty());
  if (config.textures.blend == TextureBlend::kNone || !(shown || blend)) return;
  try {
    std::vector<HeadsTextures> kinds = find_worn_textures(inputs.faces, inputs.files);
    HeadsTextures& found = kinds.front();
    const bool asked_for = sheet && sheet->texture == SheetTexture::kYes;
    if (asked_for && !found.any()) {
      throw MissingInput(concat(
          config.faces.files.front().string(),
          ": output.contact_sheet.texture asks for textures, and no head's materials name one that "
          "is there (map_Kd in the file of mtllib, and texture coordinates)"));
    }
    if (!asked_for) {
      for (std::string& text : leave_out_unreadable(found)) inputs.warn(std::move(text));
    }
    const auto load_blended = [&](const HeadsTextures& textures) {
      return load_blended_textures(inputs.faces, inputs.materials, textures, config.textures.size,
                                   cache);
    };
    const auto load_colours = [&](const HeadsTextures& textures) {
      if (textures.any() && blend && textures.differ()) return load_blended(textures);
      if (textures.any() && shown) return load_coats(textures, shown_texels(*sheet));
      HeadTextures none;
      if (!textures.any()) none.warnings = textures.warnings;
      return none;
    };
    inputs.textures = asked_for ? load_colours(found) : load_sound(found, inputs, load_colours);
    for (const std::string& text : inputs.textures.warnings) inputs.warn(text);
    for (std::size_t k = 1; blend && k < kinds.size(); ++k) {
      const bool pictured = shown && is_shown(kinds[k].kind);
      if (!pictured && config.output.meshes.empty()) continue;
      for (std::string& text : leave_out_unreadable(kinds[k])) inputs.warn(std::move(text));
      HeadTextures maps = load_sound(kinds[k], inputs, [&](const HeadsTextures& textures) {
        return textures.differ() ? load_blended(textures) : HeadTextures();
      });
      if (!kinds[k].differ()) {
        if (auto text = told_of_single(kinds[k], inputs.faces)) inputs.warn(std::move(*text));
        continue;
      }
      inputs.maps.push_back(std::move(maps));
      for (const std::string& text : inputs.maps.back().warnings) inputs.warn(text);
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
  // Of files that are not there whoever read the config has told.
  const auto is_missing = [](const std::filesystem::path& file) { return !is_there(file); };
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

std::optional<FaceSet> load_faces(const Config::Faces& faces, const CacheFolder& cache,
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

std::optional<Inputs> load_inputs(const Config& config, const CacheFolder& cache,
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
  take_colours(inputs);
  inputs.materials = face_materials(inputs.files[0].materials, inputs.faces.topology.face_count());
  inputs.cache = folder_for(cache, inputs.faces.topology);
  inputs.topology_digest = digest_of_topology(inputs.faces.topology);
  find_neighbours(inputs);
  try {
    for (std::string& text : align_heads(inputs.faces, inputs.components, config.faces.align)) {
      inputs.warn(std::move(text));
    }
  } catch (const RecoverableError& error) {
    problems.add(error);
    return std::nullopt;
  }
  hash_heads(inputs);
  inputs.mean = mean_head(inputs.faces);
  const std::size_t before = problems.size();
  find_named_parts(config, inputs, problems);
  try {
    check_stance(config, inputs);
    const std::string key = mirroring_key(config);
    if (!key.empty()) inputs.mirror = mirror_for(config, inputs, key);
  } catch (const RecoverableError& error) {
    problems.add(error);
  }
  if (problems.size() > before) return std::nullopt;
  for (std::string& text : lone_masks(config, inputs)) inputs.warn(std::move(text));
  if (auto text = far_from_origin(config, inputs)) inputs.warn(std::move(*text));
  for (std::string& text : same_persons(inputs, mm_per(config.faces.units))) {
    inputs.warn(std::move(text));
  }
  for (std::string& text : odd_expressions(inputs.faces, skin_of(inputs),
                                           axes_of(Bearing{config.faces.up, config.faces.front}),
                                           mm_per(config.faces.units))) {
    inputs.warn(std::move(text));
  }
  if (auto text = unknown_surfaces(config, inputs)) inputs.warn(std::move(*text));
  inputs.edge_length_mm = mean_edge_length_mm(config, inputs);
  try {
    inputs.regions = load_regions(config, inputs);
    if (config.distance.mask) {
      inputs.distance_mask = mask_values(inputs.faces.topology, inputs.faces.uvs,
                                         MaskSource(*config.distance.mask), skin_of(inputs));
    }
    inputs.max_level = max_level_of(config, inputs.edge_length_mm);
  } catch (const RecoverableError& error) {
    problems.add(error);
    return std::nullopt;
  }
  if (inputs.regions.uncovered_vertices > 0) {
    inputs.warn(concat(inputs.regions.uncovered_vertices,
                       " vertices are covered by no mask and go to the last region, ",
                       config.region_names().back()));
  }
  for (std::string& text : odd_masks(config, inputs)) inputs.warn(std::move(text));
  inputs.mask_digest = Hasher().add_array(numbers_of(inputs.regions.alpha)).digest();
  read_textures(config, cache, inputs, problems);
  load_shapes(config, cache, inputs, problems);
  load_points(config, inputs, problems);
  load_rig(config, inputs, problems);
  load_attachments(config, cache, inputs, problems);
  if (problems.size() > before) return std::nullopt;
  find_levels(config, cache, inputs);
  return inputs;
}

}  // namespace crowdface

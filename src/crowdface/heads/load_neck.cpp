// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/heads/load_carried.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/neck/match_rims.h"

namespace crowdface {
namespace {

/// Reads the vertex numbers of `neck.rim`, counted from 0, as a closed loop.
Rim read_rim(const std::filesystem::path& file, const Adjacency& adjacency) {
  const auto count = static_cast<std::uint64_t>(adjacency.vertex_count());
  std::vector<std::uint32_t> vertices;
  std::string text = read_file(file);
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  for (const std::string& word : words_of(text)) {
    const auto vertex = parse_unsigned(word);
    if (!vertex || *vertex >= count) {
      refuse_file(
          file, concat("expected vertex numbers from 0 to ", count - 1, ", found ", quoted(word)));
    }
    vertices.push_back(static_cast<std::uint32_t>(*vertex));
  }
  Rim rim = rim_through(vertices, adjacency);
  if (rim.empty()) {
    refuse_file(file, concat("expected the vertices of one closed loop of edges, found ",
                             vertices.size(), " vertices that form none"));
  }
  return rim;
}

Rim find_rim(const Config& config, const Inputs& inputs) {
  if (!config.neck.rim.empty()) return read_rim(config.neck.rim, inputs.adjacency);
  const Components& components = inputs.components;
  std::vector<Rim> rims = open_rims(inputs.faces.topology, inputs.adjacency);
  std::erase_if(rims, [&](const Rim& rim) {
    return components.of_vertex[rim.front()] != components.largest();
  });
  return lowest_rim(rims, mean_head(inputs.faces), unit_vector(config.faces.up),
                    mm_per(config.faces.units));
}

/// The sum of the area vectors of the polygons around each vertex of the rim, #rim by 3.
Positions areas_around(const Topology& topology, const Positions& positions, const Rim& rim) {
  const VertexFaces around(topology);
  Positions areas = Positions::Zero(static_cast<Index>(rim.size()), 3);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    for (const std::uint32_t face : around.of(rim[i])) {
      areas.row(static_cast<Index>(i)) += face_area_vector(topology, face, positions).transpose();
    }
  }
  return areas;
}

/// The goal for the heads' rim, and the area vectors of the body's polygons around it.
struct Body {
  Positions rim, areas;  ///< #rim by 3
  std::shared_ptr<Attachment> mesh = {};
  Rim mesh_rim = {};
};

/// \throws InvalidInput if the body is a head.
void keep_body(ObjFile mesh, const Rim& rim, bool is_head, Body& body) {
  if (is_head) {
    throw InvalidInput("body_texture, show_body and write_body need a body, found a head");
  }
  auto kept = std::make_shared<Attachment>();
  kept->name = kept->kind = "body";
  kept->materials = find_material_files(mesh.material_path(), mesh.material_libraries);
  kept->text = Hasher().add(mesh.file.bytes()).digest();
  kept->file = std::move(mesh);
  body.mesh = std::move(kept);
  body.mesh_rim = rim;
}

Body read_body(const Config& config, const Inputs& inputs, const Rim& rim) {
  ObjFile mesh = read_mesh_as_obj(config.neck.body);
  const double mm = mm_per(config.faces.units);
  const Positions head = mm * mean_head(inputs.faces)(rim, kAllColumns);
  const bool is_head = first_difference(inputs.faces.topology, mesh.topology).empty();
  std::vector<Rim> rims = {rim};
  if (!is_head) rims = open_rims(mesh.topology, build_adjacency(mesh.topology));
  try {
    const Rim found = matching_rim(head, rims, mm * mesh.positions, config.neck.falloff_mm);
    Body body{mesh.positions(found, kAllColumns),
              areas_around(mesh.topology, mesh.positions, found)};
    if (config.neck.needs_body_mesh()) keep_body(std::move(mesh), found, is_head, body);
    return body;
  } catch (const InvalidInput& error) {
    refuse_file(config.neck.body, error.what());
  }
}

/// The best motion without scale of one rim onto another. It rotates the head only if the rotation
/// halves the distance: necks are cut at different slopes, and a head must not tilt for that.
RigidMotion placing(const Positions& rim, const Positions& goal) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(rim.rows()));
  std::iota(all.begin(), all.end(), 0U);
  RigidMotion turned = fit_rigid_motion(rim, goal, all, std::vector<double>(all.size(), 1.0));
  turned.scale = 1;
  RigidMotion shifted{.from = turned.from, .to = turned.to};
  const auto left = [&](const RigidMotion& motion) {
    double sum = 0;
    for (Index i = 0; i < rim.rows(); ++i) {
      sum += (motion.apply(row3(rim, i)) - row3(goal, i)).squaredNorm();
    }
    return sum;
  };
  constexpr double kHalf = 0.25;  // squared
  return left(turned) < kHalf * left(shifted) ? turned : shifted;
}

void move(const RigidMotion& motion, Positions& positions) {
  for (Index i = 0; i < positions.rows(); ++i) {
    positions.row(i) = motion.apply(row3(positions, i)).transpose();
  }
}

double rms_length(const Positions& rows) {
  return rows.rowwise().norm().norm() / std::sqrt(static_cast<double>(rows.rows()));
}

/// The mean rim of the heads after each was placed on their mean in place.
Positions mean_rim(const HeadSet& faces, const Rim& rim) {
  const Positions in_place = mean_head(faces)(rim, kAllColumns);
  Positions sum = Positions::Zero(in_place.rows(), 3);
  for (const Head& head : faces.heads) {
    Positions own = head.positions(rim, kAllColumns);
    move(placing(own, in_place), own);
    sum += own;
  }
  return sum / static_cast<double>(faces.heads.size());
}

Body find_body(const Config& config, const Inputs& inputs, const Rim& rim) {
  if (!config.neck.body.empty()) return read_body(config, inputs, rim);
  const Positions none = Positions::Zero(static_cast<Index>(rim.size()), 3);
  if (!config.neck.like) return {mean_rim(inputs.faces, rim), none};
  const Positions& head = inputs.faces.heads[static_cast<std::size_t>(*config.neck.like)].positions;
  return {head(rim, kAllColumns), none};
}

/// Makes the polygons of a body face outward like those of the heads, if they face inward.
/// \param areas  the area vectors of the heads' polygons around the rim
void face_outward(const Positions& areas, Body& body) {
  if (areas.cwiseProduct(body.areas).sum() >= 0) return;
  body.areas = -body.areas;
  if (!body.mesh) return;
  Topology& topology = body.mesh->file.topology;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (auto* corners : {&topology.corner_vertices, &topology.corner_uvs}) {
      if (!corners->empty()) std::reverse(corners->begin() + begin, corners->begin() + end);
    }
  }
}

/// The normals of skin and body together.
Positions normals_of(Positions areas, const Positions& of_body) {
  areas += of_body;
  for (Index i = 0; i < areas.rows(); ++i) areas.row(i) = row3(areas, i).normalized().transpose();
  return areas;
}

/// Warns about heads whose ring is so far from the body's that the bend shows.
void warn_of_bent(const Config& config, const std::vector<HeadsOnBody::Head>& heads,
                  Inputs& inputs) {
  // The bend's largest slope is 1.5 times the displacement divided by the falloff, which is one
  // half for this displacement.
  const double most = config.neck.falloff_mm / 3;
  std::vector<std::string> bent;
  for (std::size_t h = 0; h < heads.size(); ++h) {
    if (heads[h].bent_mm <= most) continue;
    bent.push_back(
        concat(inputs.faces.heads[h].name, " (", format_fixed(heads[h].bent_mm, 1), " mm)"));
  }
  if (bent.empty()) return;
  inputs.warn(concat("neck: the rings of ", join(bent), " are farther from the body's ring than ",
                     format_fixed(most, 1), " mm, which a falloff of ", config.neck.falloff_mm,
                     " mm hides; a larger neck.falloff makes the bend smoother"));
}

/// Places a head on the body. All heads rotate alike: otherwise the body would change how heads
/// differ, and so who the faces are.
HeadsOnBody::Head place(const Rim& rim, const Positions& goal, const Eigen::Matrix3d& rotation,
                        double mm, Positions& head) {
  HeadsOnBody::Head placed;
  const Positions before = head(rim, kAllColumns);
  if (before == goal && rotation.isIdentity(0)) return placed;
  placed.placed = placing(before, goal);
  placed.placed.rotation = rotation;
  move(placed.placed, head);
  const Positions after = head(rim, kAllColumns);
  placed.moved_mm = mm * rms_length(after - before);
  placed.bent_mm = mm * (goal - after).rowwise().norm().maxCoeff();
  return placed;
}

void place_heads(const Config& config, Inputs& inputs) {
  HeadSet& faces = inputs.faces;
  const double mm = mm_per(config.faces.units);
  const Rim rim = find_rim(config, inputs);
  Body body = find_body(config, inputs, rim);
  Positions unplaced_mean = mean_head(faces);
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (!config.neck.body.empty()) {
    rotation = placing(unplaced_mean(rim, kAllColumns), body.rim).rotation;
  }
  std::vector<HeadsOnBody::Head> heads(faces.heads.size());
  parallel_for_each(heads.size(), [&](std::size_t h) {
    heads[h] = place(rim, body.rim, rotation, mm, faces.heads[h].positions);
  });
  Positions mean = mean_head(faces);
  Seam seam{rim,
            body.rim,
            {},
            NeckBend(faces.topology, inputs.adjacency, mean, rim, config.neck.falloff_mm / mm)};
  seam.fit(mean);
  const Positions areas = areas_around(faces.topology, mean, rim);
  face_outward(areas, body);
  seam.normals = normals_of(areas, body.areas);
  Hasher hasher;
  hasher.add_array(std::span(std::as_const(seam.rim)))
      .add_array(numbers_of(std::as_const(seam.positions)))
      .add_array(numbers_of(std::as_const(seam.normals)))
      .add(config.neck.falloff_mm);
  if (body.mesh) {
    hasher.add(body.mesh->text).add(int{config.neck.show_body}).add(int{config.neck.write_body});
    for (const MaterialFile& file : body.mesh->materials.files) {
      hasher.add(hash_file(file.from).digest);
    }
  }
  if (!config.neck.body_texture.empty()) hasher.add(hash_file(config.neck.body_texture).digest);
  const Digest digest = hasher.digest();
  warn_of_bent(config, heads, inputs);
  inputs.neck = std::make_shared<const HeadsOnBody>(HeadsOnBody{std::move(seam), std::move(heads),
                                                                std::move(unplaced_mean), mm,
                                                                body.mesh, body.mesh_rim, digest});
}

}  // namespace

void load_neck(const Config& config, Inputs& inputs, Problems& problems) {
  if (!config.neck.is_set()) return;
  try {
    place_heads(config, inputs);
  } catch (const RecoverableError& error) {
    problems.add(error.code(), concat(config.file.string(), ": neck: ", error.what()));
  }
}

}  // namespace crowdface

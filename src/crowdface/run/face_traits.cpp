// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_traits.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "crowdface/core/parallel.h"
#include "crowdface/core/rounded.h"
#include "crowdface/core/units.h"
#include "crowdface/heads/heads_on_body.h"
#include "crowdface/smooth/level_basis.h"

namespace crowdface {
namespace {

/// Returns for each head a trajectory: how far smoothing displaces the vertices `samples` at each
/// of the levels that stored_smoothing_levels returns. Like blending, computes the smoothed
/// positions exactly if `prepared` has a filter, otherwise from the fitted displacement fields.
std::vector<Trajectory> trajectories_at(const Config& config, const Inputs& inputs,
                                        const PreparedHeads& prepared, const FaceSamples& samples) {
  const std::vector<std::uint64_t> levels = stored_smoothing_levels(inputs.max_level);
  const std::vector<HeadSmoothing> fitted =
      prepared.filter ? std::vector<HeadSmoothing>() : head_smoothings(config, prepared);
  std::vector<Trajectory> trajectories(inputs.head_set.heads.size());
  for (std::size_t h = 0; h < trajectories.size(); ++h) {
    if (prepared.filter) {
      const NodeFields fields =
          filter_nodes(*prepared.filter, *prepared.nodes, inputs.head_set.heads[h].positions);
      trajectories[h] =
          sample_smoothing_trajectory(*prepared.filter, *prepared.nodes, fields, samples);
      continue;
    }
    Trajectory& trajectory = trajectories[h];
    trajectory.resize(static_cast<Index>(levels.size()), 3 * static_cast<Index>(samples.size()));
    parallel_for_each(levels.size(), [&](std::size_t l) {
      const std::vector<double> functions = fitted[h].functions(levels[l]);
      for (std::size_t s = 0; s < samples.size(); ++s) {
        for (Index c = 0; c < 3; ++c) {
          double sum = 0;
          for (std::size_t p = 0; p < functions.size(); ++p) {
            sum += functions[p] *
                   fitted[h].fields.value(static_cast<Index>(p), static_cast<Index>(samples[s]), c);
          }
          trajectory(static_cast<Index>(l), 3 * static_cast<Index>(s) + c) =
              static_cast<float>(sum);
        }
      }
    });
  }
  return trajectories;
}

HeadsAtSamples heads_at(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
                        const FaceSamples& samples) {
  const FaceSamples traced = inputs.mirror_map == nullptr
                                 ? samples
                                 : samples_and_mirror_corners(samples, *inputs.mirror_map);
  std::vector<Trajectory> trajectories = trajectories_at(config, inputs, prepared, traced);
  HeadsAtSamples heads = sample_heads(inputs.head_set, inputs.regions, samples, trajectories,
                                      inputs.max_level, mm_per(config.faces.units));
  heads.owned_trajectories = std::move(trajectories);
  heads.trajectories = heads.owned_trajectories;
  if (inputs.mirror_map != nullptr) {
    heads.mirror_images = sample_mirror_images(inputs.head_set, inputs.regions, *inputs.mirror_map,
                                               samples, traced, heads);
  }
  return heads;
}

Index row_of(const FaceSamples& samples, std::uint32_t v) {
  return std::ranges::lower_bound(samples, v) - samples.begin();
}

/// The corners of the triangles that contain the landmarks of these traits.
std::set<std::uint32_t> corners_of(const HeadLandmarks& landmarks,
                                   const std::vector<std::size_t>& traits) {
  std::set<std::uint32_t> corners;
  for (const std::size_t trait : traits) {
    for (const std::size_t l : landmarks_of(measurements()[trait])) {
      corners.insert(landmarks.surface_points[l]->corners.begin(),
                     landmarks.surface_points[l]->corners.end());
    }
  }
  return corners;
}

/// Removes the positions of landmarks that the measurements do not need.
HeadLandmarks needed_landmarks(HeadLandmarks landmarks, const std::vector<std::size_t>& traits) {
  std::set<std::size_t> needed;
  for (const std::size_t trait : traits) {
    const std::vector<std::size_t> of = landmarks_of(measurements()[trait]);
    needed.insert(of.begin(), of.end());
  }
  for (std::size_t l = 0; l < landmarks.surface_points.size(); ++l) {
    if (!needed.contains(l)) landmarks.surface_points[l].reset();
  }
  return landmarks;
}

}  // namespace

FaceTraits::FaceTraits(const Config& config, const Inputs& inputs, const PreparedHeads& prepared,
                       const HeadLandmarks& landmarks, std::vector<std::size_t> traits)
    : trait_indices_(std::move(traits)),
      landmarks_(needed_landmarks(landmarks, trait_indices_)),
      builder_(config, inputs, prepared),
      mm_per_unit_(mm_per(config.faces.units)),
      mirror_(inputs.mirror_map),
      heads_on_body_(inputs.heads_on_body),
      vertex_count_(inputs.head_set.topology.vertex_count) {
  const std::set<std::uint32_t> corners = corners_of(landmarks_, trait_indices_);
  std::set<std::uint32_t> all = corners;
  if (heads_on_body_ != nullptr)
    all.insert(heads_on_body_->seam.rim.begin(), heads_on_body_->seam.rim.end());
  landmark_vertices_.assign(all.begin(), all.end());
  for (const std::uint32_t v : landmark_vertices_) {
    if (mirror_) all.insert(mirror_->corners[v].begin(), mirror_->corners[v].end());
  }
  for (const std::uint32_t v : builder_.contact_vertices()) all.insert(v);
  samples_.assign(all.begin(), all.end());
  heads_ = heads_at(config, inputs, prepared, samples_);

  const FaceSamples few(corners.begin(), corners.end());
  std::vector<FaceMeasurer::Landmark> rows(landmarks_.surface_points.size());
  for (std::size_t l = 0; l < rows.size(); ++l) {
    if (!landmarks_.surface_points[l]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      rows[l].samples[c] = row_of(few, landmarks_.surface_points[l]->corners[c]);
      rows[l].weights[c] = landmarks_.surface_points[l]->barycentric[c];
    }
  }
  measurer_.emplace(heads_at(config, inputs, prepared, few), std::move(rows),
                    measure_heads(config, inputs, landmarks), [this](const Recipe& recipe) {
                      return exact_landmarks(recipe, NeckState::kAsBlended);
                    });
}

/// Applies the steps of FaceBuilder to the vertices `samples_` only: blending and asymmetry,
/// contacts, pose, mirroring, and the bend at the neck.
Positions FaceTraits::exact_landmarks(const Recipe& recipe, NeckState neck) const {
  Recipe plain = recipe;
  plain.mirrored = false;
  const Positions at = sample_face(heads_, plain) / mm_per_unit_;
  thread_local Positions face;  // only the rows listed in samples_ are set
  if (face.rows() != vertex_count_) face = Positions::Zero(vertex_count_, 3);
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    face.row(samples_[s]) = at.row(static_cast<Index>(s));
  }
  builder_.correct_contacts(plain, face);
  if (const auto turn = neck == NeckState::kBent ? builder_.motion_to_body(recipe) : std::nullopt) {
    for (const std::uint32_t v : samples_) face.row(v) = turn->apply(row3(face, v)).transpose();
  }
  if (recipe.mirrored) mirror_landmark_vertices(face);
  if (heads_on_body_ != nullptr && neck == NeckState::kBent)
    heads_on_body_->seam.bend_to_seam(face);
  return landmarks_.landmark_positions(face, mm_per_unit_);
}

void FaceTraits::mirror_landmark_vertices(Positions& face) const {
  Positions images(static_cast<Index>(landmark_vertices_.size()), 3);
  for (std::size_t i = 0; i < landmark_vertices_.size(); ++i) {
    const std::uint32_t v = landmark_vertices_[i];
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      point += mirror_->barycentric[v][c] * row3(face, mirror_->corners[v][c]);
    }
    point = mirror_->plane.mirrored(point);
    const auto kept = std::ranges::lower_bound(mirror_->unpaired_vertices, v);
    if (kept != mirror_->unpaired_vertices.end() && *kept == v) {
      point += row3(mirror_->unpaired_offsets, kept - mirror_->unpaired_vertices.begin());
    }
    images.row(static_cast<Index>(i)) = point.transpose();
  }
  for (std::size_t i = 0; i < landmark_vertices_.size(); ++i) {
    face.row(landmark_vertices_[i]) = images.row(static_cast<Index>(i));
  }
}

std::vector<double> FaceTraits::values(const Recipe& recipe) const {
  const Positions points = exact_landmarks(recipe, NeckState::kBent);
  std::vector<double> values;
  for (const std::size_t trait : trait_indices_)
    values.push_back(measure(measurements()[trait], points));
  return values;
}

std::unique_ptr<const FaceTraits> face_traits_of_config(const Config& config, const Inputs& inputs,
                                                        const PreparedHeads& prepared) {
  std::vector<std::size_t> traits = config.named_traits();
  if (traits.empty()) return nullptr;
  const HeadLandmarks landmarks = find_head_landmarks(config, inputs);
  require_available_traits(config, landmarks);
  return std::make_unique<const FaceTraits>(config, inputs, prepared, landmarks, std::move(traits));
}

std::unique_ptr<const FaceTraits> available_face_traits(const Config& config, const Inputs& inputs,
                                                        const PreparedHeads& prepared) {
  const HeadLandmarks landmarks = find_head_landmarks(config, inputs);
  require_available_traits(config, landmarks);
  std::vector<std::size_t> available;
  for (std::size_t m = 0; m < measurements().size(); ++m) {
    if (landmarks.can_measure(measurements()[m])) available.push_back(m);
  }
  if (available.empty()) return nullptr;
  return std::make_unique<const FaceTraits>(config, inputs, prepared, landmarks,
                                            std::move(available));
}

void measure_faces(const FaceTraits& traits, std::vector<FacePlan>& crowd) {
  parallel_for_each(crowd.size(), [&](std::size_t i) {
    crowd[i].traits = traits.values(crowd[i].recipe);
    for (double& value : crowd[i].traits) value = rounded(value);
  });
}

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/identity.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

double cut_normal(const RandomKey& key) {
  return std::clamp(random_normal(key), -2.2, 2.2);
}

Vector3d displacement(const LocalDisplacement& pull, const Vector3d& p) {
  const Vector3d from = p - pull.centre;
  const double r2 = from.cwiseQuotient(pull.radii).squaredNorm();
  if (r2 >= 1) return Vector3d::Zero();
  const double kernel = (1 - r2) * (1 - r2) * (1 - r2);
  return kernel * (pull.shift + pull.stretch.cwiseProduct(from));
}

LocalDisplacement mirrored(LocalDisplacement pull) {
  pull.centre.x() = -pull.centre.x();
  pull.shift.x() = -pull.shift.x();
  return pull;
}

}  // namespace

Person random_person(std::uint64_t seed, std::uint64_t index) {
  Person person;
  // Use stratified random numbers, so that even a few heads include both sexes and several ages.
  person.maleness = random_stratified({seed, index, "synth/sex"}, 2) < 0.5 ? -1 : 1;
  person.age_years = std::floor(18 + 60 * random_stratified({seed, index, "synth/age"}, 5));
  person.build = std::clamp(random_normal({seed, index, "synth/build"}), -2.0, 2.0);
  return person;
}

Identity::Identity(std::uint64_t seed, std::uint64_t index)
    : seed_(seed),
      index_(index),
      person_(random_person(seed, index)),
      asymmetry_noise_(mix(seed, index, 1), 5.5) {
  const auto normal = [&](std::string_view name) {
    const std::string purpose = concat("synth/", name);
    return cut_normal({seed, index, purpose});
  };
  const double aged = person_.scaled_age();
  // Choose a random value for each measure, distributed around the average for this person's sex,
  // age and build.
  for (const Measure& measure : measures()) {
    double value = measure.maleness_effect * person_.maleness + measure.age_effect * aged +
                   measure.build_effect * person_.build + measure.spread * normal(measure.name) +
                   measure.mean;
    // Keep extreme heads plausible.
    value = std::clamp(value, -2.4, 2.4);
    LocalDisplacement pull = measure.displacement;
    pull.shift *= value;
    pull.stretch *= value;
    displacements_.push_back(pull);
    if (pull.centre.x() != 0) displacements_.push_back(mirrored(pull));
  }
  // Choose overall size, proportions and asymmetry at random.
  const double size = 0.018 * person_.maleness + 0.02 * normal("size");
  scale_ =
      Vector3d(1 + size + 0.03 * normal("width") + 0.012 * person_.build + 0.004 * person_.maleness,
               1 + size + 0.025 * normal("height"), 1 + size + 0.025 * normal("depth"));
  // The asymmetry of faces increases with age (Skomina et al. 2020).
  asymmetry_amplitude_ = 0.05 * (1 + 0.25 * aged);
  face_length_ = 0.014 * person_.maleness + 0.04 * normal("face_length");
  displacements_.push_back(
      {{0, -2.5, 11}, {2.5, 4, 3}, {0.07 * normal("nose_lean"), 0, 0}, Vector3d::Zero()});
  displacements_.push_back(
      {{0, -9, 8}, {7, 6, 8}, {0.08 * normal("jaw_lean"), 0, 0}, Vector3d::Zero()});
}

Vector3d Identity::deform(const Vector3d& point) const {
  Vector3d moved = point;
  for (const LocalDisplacement& pull : displacements_) moved += displacement(pull, point);
  // Lengthen or shorten the face below the eyes, with a smooth transition at the eyes.
  moved.y() += face_length_ * (point.y() - std::sqrt(point.y() * point.y() + 4)) / 2;
  const double uneven = asymmetry_noise_.at(point),
               other = asymmetry_noise_.at(point + Vector3d(40, 0, 0));
  moved += asymmetry_amplitude_ *
           Vector3d(uneven, other, asymmetry_noise_.at(point + Vector3d(0, 40, 0)));
  return moved.cwiseProduct(scale_);
}

}  // namespace crowdface::synth

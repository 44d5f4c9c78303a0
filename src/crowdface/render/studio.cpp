// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/studio.h"

#include <Eigen/Geometry>

namespace crowdface {

const Material& material_of(SurfaceKind kind) {
  struct Materials {
    Material skin, eye, iris, teeth, gums, attachments;
  };
  static const Materials materials = {
      .skin = {{0.47F, 0.385F, 0.335F}, {0.30F, 0.19F, 0.14F}, 0.48F, 0.03F},
      .eye = {{0.66F, 0.63F, 0.60F}, {0.15F, 0.12F, 0.10F}, 0.16F, 0.04F},
      .iris = {{0.075F, 0.052F, 0.040F}, {0.05F, 0.05F, 0.05F}, 0.14F, 0.04F},
      .teeth = {{0.68F, 0.62F, 0.52F}, {0.15F, 0.12F, 0.10F}, 0.25F, 0.04F},
      .gums = {{0.42F, 0.20F, 0.18F}, {0.20F, 0.10F, 0.08F}, 0.30F, 0.04F},
      .attachments = {{0.5F, 0.5F, 0.5F}, {0.30F, 0.28F, 0.26F}, 0.45F, 0.03F}};
  switch (kind) {
    case SurfaceKind::kEye:
      return materials.eye;
    case SurfaceKind::kIris:
      return materials.iris;
    case SurfaceKind::kTeeth:
      return materials.teeth;
    case SurfaceKind::kGums:
      return materials.gums;
    case SurfaceKind::kAttachment:
      return materials.attachments;
    case SurfaceKind::kSkin:
    case SurfaceKind::kHidden:
      break;
  }
  return materials.skin;
}

const Studio& studio() {
  static const Studio lamps = {
      .key = {Eigen::Vector3f(-0.62F, 0.62F, 0.62F).normalized(), {1.55F, 1.49F, 1.39F}},
      .fill = {Eigen::Vector3f(0.85F, 0.05F, 0.55F).normalized(), {0.15F, 0.165F, 0.185F}},
      .rim_right = {Eigen::Vector3f(0.80F, 0.35F, -0.50F).normalized(), {0.64F, 0.65F, 0.67F}},
      .rim_left = {Eigen::Vector3f(-0.85F, 0.25F, -0.55F).normalized(), {0.255F, 0.26F, 0.265F}},
      .sky_above = {0.29F, 0.30F, 0.315F},
      .sky_below = {0.10F, 0.093F, 0.086F}};
  return lamps;
}

LinearRgb albedo_of(SurfaceKind kind) {
  return material_of(kind).albedo;
}

Eigen::Vector3f key_light_direction() {
  return studio().key.direction;
}

bool can_receive_key_light(const Eigen::Vector3f& normal, SurfaceKind kind) {
  return normal.dot(studio().key.direction) > -material_of(kind).wrap.maxCoeff();
}

LinearRgb background_colour(float y) {
  return LinearRgb(0.23F, 0.235F, 0.245F) * (1 - 0.48F * y);
}

}  // namespace crowdface

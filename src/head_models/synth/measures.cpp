// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/measures.h"

#include <array>

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

LocalDisplacement shifted(const Vector3d& centre, const Vector3d& radii, const Vector3d& shift) {
  return {centre, radii, shift, Vector3d::Zero()};
}
LocalDisplacement stretched(const Vector3d& centre, const Vector3d& radii,
                            const Vector3d& stretch) {
  return {centre, radii, Vector3d::Zero(), stretch};
}

}  // namespace

std::span<const Measure> measures() {
  // clang-format off
  static const std::array list = {
      // skull
      Measure{"forehead_slope", -0.6, 0, 0, 0.9, shifted({0, 7.5, 6.5}, {9, 6, 9}, {0, 0, 0.5})},
      Measure{"forehead_bosses", -0.4, 0, 0, 0.9, shifted({2.6, 5.6, 8.4}, {4, 4, 5}, {0.05, 0, 0.16})},
      Measure{"temple", 0, -0.9, 0.4, 0.9, shifted({6.6, 3.2, 4.5}, {3.5, 5, 5.5}, {0.3, 0, 0.05})},
      Measure{"crown", 0, 0, 0, 1, shifted({0, 11, -1}, {11, 6.5, 11}, {0, 0.3, 0})},
      Measure{"occiput", 0.2, 0, 0, 0.7, shifted({0, 2, -10}, {9, 8.5, 8}, {0, 0, -0.4})},
      // brows
      Measure{"brow_ridge", 1.2, 0.05, 0, 0.7, shifted({2.3, 1.7, 9}, {3.8, 1.8, 3.2}, {0, -0.04, 0.22})},
      Measure{"glabella", 0.6, 0.1, 0, 0.8, shifted({0, 1.9, 9.5}, {2.0, 1.8, 2.8}, {0, 0, 0.15})},
      Measure{"brow_height", -0.6, -0.2, 0, 0.9, shifted({3, 1.8, 8.6}, {4, 1.8, 4}, {0, 0.17, 0})},
      Measure{"brow_tail", -0.75, -0.3, 0, 0.6, shifted({4.7, 1.5, 7.2}, {2.2, 1.7, 3}, {0, 0.17, 0})},
      // eyes
      Measure{"eye_spacing", -0.1, 0, 0, 1.2, shifted({3.12, 0, 8}, {3.0, 3.2, 4.5}, {0.13, 0, 0})},
      Measure{"eye_size", -0.65, -0.1, 0, 1.1, stretched({3.12, 0, 8.2}, {2.6, 2.2, 3}, {0.05, 0.07, 0.03})},
      Measure{"eye_opening", -0.35, -0.8, 0, 0.9, stretched({3.12, 0, 8.3}, {2.4, 1.5, 2.5}, {0, 0.12, 0})},
      Measure{"eye_tilt", -0.3, -0.3, 0, 1, shifted({4.6, 0.1, 7.4}, {1.9, 2.0, 2.8}, {0, 0.13, 0})},
      Measure{"inner_corner", 0, 0, 0, 1, shifted({1.65, -0.1, 8}, {1.3, 1.5, 2.2}, {0.03, 0.07, 0})},
      Measure{"eye_depth", -0.3, -0.5, 0.2, 1, shifted({3.12, 0, 8}, {2.8, 2.4, 4.5}, {0, 0, 0.2})},
      Measure{"lid_fold", 0, 0.6, 0.3, 0.7, shifted({3.5, 1.0, 8.5}, {2.0, 0.9, 2.0}, {0, -0.08, 0.12})},
      Measure{"eye_bags", 0.1, 1.1, 0.2, 0.6, shifted({3.1, -1.15, 8.4}, {1.6, 0.7, 1.6}, {0, -0.03, 0.10})},
      // nose
      Measure{"nose_length", 0.3, 0.45, 0, 1.1, shifted({0, -3.9, 11}, {3.2, 3.4, 4.5}, {0, -0.28, 0})},
      Measure{"nose_protrusion", 0.45, 0.2, 0, 0.9, shifted({0, -3.4, 11.3}, {2.9, 3.6, 3.8}, {0, 0, 0.24})},
      Measure{"nose_root", 0.4, 0, 0, 1, shifted({0, 0.3, 9.3}, {1.9, 2.3, 2.8}, {0, 0, 0.22})},
      Measure{"nose_hump", 0.3, 0.2, 0, 1, shifted({0, -1.2, 10.4}, {1.4, 1.8, 2.2}, {0, 0, 0.16})},
      Measure{"bridge_width", 0.3, 0, 0.1, 1, shifted({0.8, -1, 9.6}, {1.3, 2.4, 2.2}, {0.12, 0, 0})},
      Measure{"nose_width", 0.4, 0.1, 0.1, 1.1, shifted({1.3, -3.9, 10.1}, {1.9, 1.8, 2.5}, {0.20, 0, 0})},
      Measure{"wing_height", 0, 0, 0, 1, shifted({1.4, -3.9, 10}, {1.2, 1.2, 1.5}, {0, 0.13, 0})},
      Measure{"tip_turn", -0.6, -0.45, 0, 1, shifted({0, -3.7, 11.4}, {2.3, 2.2, 2.6}, {0, 0.18, 0})},
      Measure{"tip_bulb", 0.2, 0.2, 0.2, 1, stretched({0, -3.5, 11.3}, {1.7, 1.6, 1.7}, {0.14, 0.05, 0.04})},
      // mouth
      Measure{"mouth_width", 0.3, 0.1, 0, 1.0, shifted({2.4, -7, 8.9}, {2.4, 2.2, 3.5}, {0.24, 0, -0.03})},
      Measure{"upper_lip", -0.7, -0.55, 0, 1.0, shifted({0, -6.6, 10}, {3.0, 0.9, 2.2}, {0, 0.07, 0.12})},
      Measure{"lower_lip", -0.6, -0.45, 0, 1.0, shifted({0, -7.55, 9.9}, {2.9, 1.0, 2.2}, {0, -0.09, 0.13})},
      Measure{"cupid_bow", -0.2, -0.3, 0, 1, shifted({0.55, -6.3, 10}, {0.8, 0.6, 1.2}, {0, 0.07, 0.05})},
      Measure{"mouth_height", -0.1, -0.3, 0, 1, shifted({1.6, -7, 9.5}, {3.2, 2.4, 4.5}, {0, 0.18, 0})},
      Measure{"mouth_protrusion", 0, -0.3, 0, 1, shifted({0, -7, 9.8}, {3.8, 2.6, 4.5}, {0, 0, 0.24})},
      Measure{"mouth_corners", 0, 0.1, 0, 0.3, shifted({2.4, -7.05, 9}, {1.7, 1.4, 2.4}, {0, 0.10, 0}), 0.25},
      // cheeks and jaw
      Measure{"cheekbone_width", 0.5, 0, 0, 1, shifted({6, -2, 4}, {3.8, 3.2, 5.5}, {0.28, 0, 0})},
      Measure{"cheekbone_forward", -0.45, -0.3, 0, 1, shifted({4.5, -2.5, 6.6}, {3.2, 2.4, 3.8}, {0.08, 0, 0.26})},
      Measure{"cheek_fullness", -0.3, -0.5, 1.1, 0.8, shifted({4.3, -5.5, 5.5}, {3.2, 3.8, 4.8}, {0.36, 0, 0.30})},
      Measure{"cheek_hollow", 0.2, 0.8, -0.5, 0.8, shifted({5.0, -4.7, 5.0}, {2.2, 2.4, 3.2}, {-0.20, 0, -0.15})},
      Measure{"jaw_width", 0.35, 0, 0.35, 0.9, shifted({5, -7.6, 2.5}, {4.8, 6.5, 7}, {0.36, 0, 0})},
      Measure{"jaw_angle", 0.2, 0, 0, 1, shifted({4.9, -7.6, 1.5}, {3.4, 4.2, 4.6}, {0.16, -0.18, -0.05})},
      Measure{"chin_forward", 0.3, 0.1, -0.1, 1, shifted({0, -10.3, 9}, {4.5, 3.2, 5}, {0, 0, 0.36})},
      Measure{"chin_height", 0.4, 0, 0, 1, shifted({0, -10.8, 8}, {5.5, 3.6, 6.5}, {0, -0.32, 0})},
      Measure{"chin_width", 0.6, 0, 0.2, 0.9, shifted({2.2, -10.2, 7}, {4.0, 3.4, 5.5}, {0.26, 0, 0})},
      Measure{"chin_cleft", 0.3, 0, 0, 0.8, shifted({0, -10.2, 9.6}, {0.9, 1.4, 1.6}, {0, 0, -0.06})},
      Measure{"chin_pad", 0.1, 0, 0.1, 1, shifted({0, -10.1, 9.7}, {2.0, 1.4, 2.0}, {0, 0, 0.12})},
      Measure{"jowls", 0.1, 1.2, 0.5, 0.5, shifted({3.6, -9.6, 6}, {2.3, 2.4, 3.2}, {0.14, -0.26, 0.05})},
      Measure{"throat", 0.1, 0.6, 1.1, 0.5, shifted({0, -12, 5}, {5, 2.8, 5}, {0, -0.40, 0.25})},
      Measure{"larynx", 0.9, 0.1, -0.2, 0.4, shifted({0, -14.0, 3.2}, {1.5, 1.8, 2.2}, {0, 0, 0.25})},
      Measure{"neck_width", 1.2, 0, 0.7, 0.5, stretched({0, -16, -2.5}, {12, 8.5, 12}, {0.07, 0, 0.05})},
      // ears
      Measure{"ear_size", 0.3, 0.6, 0, 0.9, stretched({7.8, -2.5, -1.8}, {4, 5.5, 4.8}, {0, 0.09, 0.08})},
      Measure{"ear_stand_off", 0.1, 0, 0, 1, shifted({8.6, -2.3, -2.6}, {2.6, 5, 3.8}, {0.24, 0, 0.05})},
      Measure{"ear_tilt", 0, 0, 0, 1, shifted({7.8, 0.5, -2}, {3, 3.6, 4}, {0, 0, -0.3})},
      Measure{"ear_lobe", 0, 0.8, 0, 0.9, shifted({7.6, -5.2, -0.6}, {2.5, 2.2, 2.5}, {0, -0.20, 0})},
      Measure{"ear_width", 0.1, 0.1, 0, 1, stretched({7.8, -2.5, -1.6}, {4, 5.2, 4.4}, {0, 0, 0.10})},
      Measure{"ear_top", 0, 0, 0, 1, shifted({7.8, 0, -1.6}, {2.6, 2.4, 3}, {0.10, 0.22, 0.06})},
      Measure{"ear_place", 0, -0.1, 0, 1, shifted({7.8, -2.5, -1.6}, {3.6, 6, 5}, {0, 0.22, 0.12})},
      Measure{"ear_flare", 0.1, 0, 0, 1, shifted({9.0, -0.8, -3.2}, {2.4, 3.4, 3}, {0.14, 0, 0})},
  };
  // clang-format on
  return list;
}

}  // namespace crowdface::synth

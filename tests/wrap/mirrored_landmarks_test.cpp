// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/mirrored_landmarks.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace crowdface::testing {
namespace {

/// Places of a somewhat uneven face, in mm.
struct Face {
  Positions positions{7, 3};
  std::vector<WrapLandmark> landmarks;

  Face() {
    positions << -30, 0, 0, 32, 1, 2, -25, -60, 5, 26, -58, 4, 0, -30, 30, 1, -90, 15, 3, 60, -10;
    const char* names[] = {"eye_right", "eye_left", "mouth_right", "mouth_left",
                           "nose",      "chin",     "top"};
    for (std::uint32_t v = 0; v < 7; ++v) {
      landmarks.push_back(
          {names[v], v, 2 * positions.row(v).transpose() + Eigen::Vector3d(5, 6, 7)});
    }
  }
};

TEST(MirroredLandmarks, SoundOnesPass) {
  const Face face;
  EXPECT_NO_THROW(refuse_mirrored_landmarks(face.positions, face.landmarks));
}

TEST(MirroredLandmarks, AMirroredScanIsToldFromExchangedNames) {
  Face mirrored;
  for (WrapLandmark& landmark : mirrored.landmarks) landmark.place.z() = -landmark.place.z();
  expect_error(ExitCode::kBadData,
               {"the scan is mirrored: with a reflection the landmarks fit to 0.0 mm"},
               [&] { refuse_mirrored_landmarks(mirrored.positions, mirrored.landmarks); });
  Face exchanged;
  std::swap(exchanged.landmarks[0].place, exchanged.landmarks[1].place);
  std::swap(exchanged.landmarks[2].place, exchanged.landmarks[3].place);
  expect_error(ExitCode::kBadData, {"left and right are swapped in the names"},
               [&] { refuse_mirrored_landmarks(exchanged.positions, exchanged.landmarks); });
}

}  // namespace
}  // namespace crowdface::testing

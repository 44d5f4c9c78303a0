// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/mirrored_landmarks.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"

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
  for (WrapLandmark& landmark : mirrored.landmarks)
    landmark.scan_position.z() = -landmark.scan_position.z();
  expect_error(ExitCode::kBadData,
               {"the scan is mirrored: with a reflection the landmarks fit to 0.0 mm"},
               [&] { refuse_mirrored_landmarks(mirrored.positions, mirrored.landmarks); });
  Face exchanged;
  std::swap(exchanged.landmarks[0].scan_position, exchanged.landmarks[1].scan_position);
  std::swap(exchanged.landmarks[2].scan_position, exchanged.landmarks[3].scan_position);
  expect_error(ExitCode::kBadData, {"left and right are swapped in the names"},
               [&] { refuse_mirrored_landmarks(exchanged.positions, exchanged.landmarks); });
}

TEST(MirroredLandmarks, ASwappedPairIsNamed) {
  const Face sound;
  EXPECT_NO_THROW(refuse_swapped_pair(sound.positions, sound.landmarks));
  Face misplaced;  // in no place of another landmark
  misplaced.landmarks[4].scan_position += Eigen::Vector3d(30, 20, 40);
  EXPECT_NO_THROW(refuse_swapped_pair(misplaced.positions, misplaced.landmarks));
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = i + 1; j < 7; ++j) {
      Face face;
      std::swap(face.landmarks[i].scan_position, face.landmarks[j].scan_position);
      const std::string pair = concat(crowdface::quoted(face.landmarks[i].name), " and ",
                                      crowdface::quoted(face.landmarks[j].name));
      expect_error(ExitCode::kBadData, {pair + " are swapped", "fit to 0.0 mm instead of"},
                   [&] { refuse_swapped_pair(face.positions, face.landmarks); });
    }
  }
}

}  // namespace
}  // namespace crowdface::testing

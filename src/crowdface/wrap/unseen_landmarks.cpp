// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/unseen_landmarks.h"

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr std::size_t kOneByOne = 12, kFolds = 4;

}  // namespace

std::map<std::string, double> unseen_landmarks(const WrapTemplate& shape, const ShapeModel* model,
                                               const Scan& scan,
                                               const std::vector<WrapLandmark>& landmarks,
                                               const std::optional<PoseHint>& hint,
                                               const WrapOptions& options) {
  std::map<std::string, double> unseen;
  if (!hint && landmarks.size() <= kFewestLandmarks) return unseen;
  const std::size_t folds = landmarks.size() < kOneByOne ? landmarks.size() : kFolds;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<WrapLandmark> known, left_out;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      (i % folds == fold ? left_out : known).push_back(landmarks[i]);
    }
    const WrapResult result = wrap(shape, model, scan, known, hint, options);
    const Similarity back = inverse(result.pose);
    for (const WrapLandmark& landmark : left_out) {
      unseen[landmark.name] =
          length3(row3(result.positions, landmark.vertex) - carried(back, landmark.place));
    }
  }
  return unseen;
}

}  // namespace crowdface

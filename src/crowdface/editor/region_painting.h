// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/editor/edit_session.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/paint/mask_painter.h"

namespace crowdface {

/// The regions of a job as they are painted on the editor's page. One thread at a time.
class RegionPainting {
 public:
  /// \param session  must outlive this object
  explicit RegionPainting(EditSession& session);

  /// One touch of the brush: {region, mode, points: [{triangle, u, v}…] on the preview, radius_mm, strength,
  /// falloff, mirror, begin}; without `begin` it goes on with the touch before.
  /// \throws UsageError if the request cannot be read.
  void stroke(const nlohmann::ordered_json& body);
  /// Takes the last touch back. \throws UsageError if there is none.
  void undo();
  /// Whether masks are other than the config's.
  bool painted() const { return painter_ && painter_->can_undo(); }

  /// α at the preview's vertices, row by row; zero at parts that are no skin.
  std::vector<float> masks() const;

  /// Faces are blended with what is painted from now on.
  void apply();

  /// Writes images in the layout of the texture.
  /// \return what a config's `regions.mask` has to name
  /// \throws InvalidInput if the heads have no texture coordinates; CannotCreate.
  std::vector<std::filesystem::path> save(const std::filesystem::path& folder);

 private:
  MaskPainter& painter();
  SurfacePoint place_of(const nlohmann::ordered_json& point);

  EditSession& session_;
  HeadShape mean_;
  std::optional<MaskPainter> painter_;  ///< made by the first touch
  bool painted_ = false;                ///< since `apply`
};

}  // namespace crowdface

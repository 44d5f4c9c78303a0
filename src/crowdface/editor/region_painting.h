// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/editor/edit_session.h"
#include "crowdface/editor/stroke_log.h"
#include "crowdface/paint/face_marks.h"
#include "crowdface/paint/mask_painter.h"

namespace crowdface {

/// Regions as they are to be: their names, and α of every vertex.
struct PaintedRegions {
  std::vector<std::string> names;
  RegionWeights::Alpha alpha;  ///< #V by #names
};

/// The regions of a job as they are painted on the editor's page. One thread at a time.
class RegionPainting {
 public:
  /// What was painted on these masks before and not saved is painted again.
  /// \param session  must outlive this object
  /// \param strokes  the file that keeps what is painted
  RegionPainting(EditSession& session, const std::filesystem::path& strokes);

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

  /// What is painted, with {"add": NAME}: and a region that is nowhere yet; {"remove": NAME}: without one,
  /// whose share the others take; {"propose": [NAME…]}: what the mean head's shape proposes, in its place.
  /// \throws UsageError if the request cannot be read; InvalidInput if there is nothing to propose.
  PaintedRegions regions(const nlohmann::ordered_json& change);

  /// Writes images in the layout of the texture.
  /// \param path  of the first, ending in .png
  /// \return what a config's `regions.mask` has to name
  /// \throws InvalidInput if the heads have no texture coordinates; CannotCreate.
  std::vector<std::filesystem::path> save(const PaintedRegions& regions,
                                          const std::filesystem::path& path) const;
  /// The config's masks hold what is painted.
  void forget() { strokes_.clear(); }

 private:
  MaskPainter& painter();
  SurfacePoint place_of(const nlohmann::ordered_json& point);
  Index region_in(const nlohmann::ordered_json& body, const std::string& key) const;
  void paint(const nlohmann::ordered_json& body);
  /// Paints all strokes of the file.
  void replay();
  /// Adds what was just painted to the file; if that fails it is not painted either.
  void keep(const nlohmann::ordered_json& step);

  EditSession& session_;
  HeadShape mean_;
  std::optional<MaskPainter> painter_;  ///< made by the first touch
  bool painted_ = false;                ///< since `apply`
  StrokeLog strokes_;
};

}  // namespace crowdface

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

/// A set of regions: their names and the weights α of every vertex.
struct PaintedRegions {
  std::vector<std::string> names;
  RegionWeights::Alpha alpha;  ///< #V by #names
};

/// The painted regions of a job, for the editor's page. Not thread-safe.
class RegionPainting {
 public:
  /// Replays strokes that were painted on the same masks earlier but not saved.
  /// \param session  must outlive this object
  /// \param strokes  file that stores the strokes
  RegionPainting(EditSession& session, const std::filesystem::path& strokes);

  /// Applies one brush stroke: {region, mode, points: [{triangle, u, v}…] on the preview,
  /// radius_mm, strength, falloff, mirror, begin}. Without `begin`, the stroke continues the
  /// previous one.
  /// \throws UsageError if the request cannot be read.
  void stroke(const nlohmann::ordered_json& body);
  /// Undoes the last stroke.
  /// \throws UsageError if there is none.
  void undo();
  /// Whether the masks differ from the config's masks.
  bool differs_from_config() const { return painter_ && painter_->can_undo(); }

  /// α at the preview's vertices, row by row; zero at components that are not skin.
  std::vector<float> masks() const;

  /// Uses the painted masks for blending from now on.
  void apply();

  /// The painted regions with one change. {"add": NAME} adds a region without any vertices.
  /// {"remove": NAME} removes a region and distributes its share to the other regions. {"propose":
  /// [NAME…]} replaces all regions by the regions that the shape of the mean head suggests.
  /// \throws UsageError if the request cannot be read; InvalidInput if no regions can be proposed.
  PaintedRegions regions(const nlohmann::ordered_json& change);

  /// Writes the masks as images in the layout of the texture.
  /// \param path  file of the first image, ending in .png
  /// \return the files for the config's `regions.mask`
  /// \throws InvalidInput if the heads have no texture coordinates; CannotCreate.
  std::vector<std::filesystem::path> save(const PaintedRegions& regions,
                                          const std::filesystem::path& path) const;
  /// Deletes the stored strokes. Call this once the config's masks contain them.
  void delete_stored_strokes() { strokes_.clear(); }

 private:
  MaskPainter& painter();
  SurfacePoint surface_point_of(const nlohmann::ordered_json& point);
  Index region_in(const nlohmann::ordered_json& body, const std::string& key) const;
  void paint(const nlohmann::ordered_json& body);
  /// Applies all strokes of the file.
  void replay();
  /// Appends a stroke that was just painted to the file; if this fails, undoes the stroke.
  void store(const nlohmann::ordered_json& step);

  EditSession& session_;
  HeadShape mean_;
  std::optional<MaskPainter> painter_;  ///< created at the first stroke
  bool painted_ = false;                ///< whether anything was painted since the last `apply`
  StrokeLog strokes_;
};

}  // namespace crowdface

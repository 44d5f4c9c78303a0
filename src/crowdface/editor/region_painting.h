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

/// A set of regions: the names of the regions, and each vertex's weights α for the regions.
struct PaintedRegions {
  std::vector<std::string> names;
  RegionWeights::Alpha alpha;  ///< #V by #names: the weight of each vertex for each region
};

/// The painted regions of a job, for the editor's page. Not thread-safe.
class RegionPainting {
 public:
  /// Applies the stored brush strokes again: strokes that the user painted on the same masks in an
  /// earlier run of the editor, and whose result was not saved as masks.
  /// \param session  must outlive this object
  /// \param strokes  file that stores the strokes
  RegionPainting(EditSession& session, const std::filesystem::path& strokes);

  /// Applies one brush stroke: {region, mode, points: [{triangle, u, v}…] on the preview,
  /// radius_mm, strength, falloff, mirror, begin}. Without `begin`, the stroke continues the
  /// previous stroke.
  /// \throws UsageError if the request cannot be read.
  void apply_stroke(const nlohmann::ordered_json& body);
  /// Undoes the last brush stroke.
  /// \throws UsageError if there is no stroke to undo.
  void undo();
  /// Whether the painted masks differ from the config's masks, that is, whether there is a stroke
  /// to undo.
  bool differs_from_config() const { return painter_ && painter_->can_undo(); }

  /// The weights α at the preview's vertices: for each vertex, one number per region. Zero at
  /// vertices of components that are not skin.
  std::vector<float> masks() const;

  /// Makes the session blend faces with the painted masks from now on.
  void apply_masks();

  /// Returns the painted regions after one change. {"add": NAME} adds a region without any
  /// vertices. {"remove": NAME} removes a region and distributes the region's weights to the other
  /// regions. {"propose": [NAME…]} replaces all regions by regions that are computed from the shape
  /// of the mean head.
  /// \throws UsageError if the request cannot be read; InvalidInput if no regions can be proposed.
  PaintedRegions changed_regions(const nlohmann::ordered_json& change);

  /// Writes the masks as images in the heads' texture layout.
  /// \param path  file of the first image, ending in .png
  /// \return the files for the config's `regions.mask`
  /// \throws InvalidInput if the heads have no texture coordinates; CannotCreate.
  std::vector<std::filesystem::path> save(const PaintedRegions& regions,
                                          const std::filesystem::path& path) const;
  /// Deletes the stored strokes. Call this function after the config's masks contain the effect of
  /// the strokes.
  void delete_stored_strokes() { strokes_.clear(); }

 private:
  /// Returns `painter_`; creates the painter at the first call.
  MaskPainter& painter();
  /// Reads a point {triangle, u, v} on the preview.
  SurfacePoint surface_point_of(const nlohmann::ordered_json& point);
  /// Returns the index of the region whose name is the value of `key` in `body`.
  Index region_in(const nlohmann::ordered_json& body, const std::string& key) const;
  /// Applies one brush stroke as apply_stroke does, but does not store the stroke.
  void paint(const nlohmann::ordered_json& body);
  /// Discards the painted masks. Then applies all strokes and undo steps that the file stores.
  void replay_strokes();
  /// Appends a brush stroke or an undo step to the file of strokes. If writing fails, restores the
  /// masks from the strokes that the file stores.
  void store_step(const nlohmann::ordered_json& step);

  EditSession& session_;
  HeadShape mean_head_;
  std::optional<MaskPainter> painter_;  ///< paints the masks; created at the first stroke
  /// whether the painted masks have changed since the last call of `apply_masks`
  bool has_unapplied_paint_ = false;
  StrokeLog strokes_;
};

}  // namespace crowdface

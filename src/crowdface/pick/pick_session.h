// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/pick/landmark_file.h"
#include "crowdface/pick/pickable_mesh.h"
#include "crowdface/pick/suggested_places.h"
#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// The template, the scan, and the landmark file to write.
struct PickInputs {
  const WrapTemplate& wrap_template;
  Positions template_positions;  ///< positions of the template's vertices, #V by 3, in millimetres
  /// #V by 3: positions of the template, in the unit of the template's file. The landmark file
  /// gives template points in this unit.
  Positions template_file_positions;
  Scan scan;
  /// up and front directions of the scanned head; estimated if not given
  std::optional<PoseHint> hint;
  std::filesystem::path template_file, scan_file, landmark_file;
  /// Path of another landmark file, for template landmarks that `landmark_file` lacks; may be
  /// empty.
  std::filesystem::path template_landmark_file = {};
  ColourRows scan_colours = {};  ///< colours of the scan's vertices, or no rows
};

/// Picks landmarks on a template and a scan by ray casting, and reads and writes the landmark file.
class PickSession {
 public:
  /// Reads the landmark file if it exists.
  /// \param inputs  `inputs.wrap_template` must outlive this object
  /// \throws Error that names the fault in the file
  explicit PickSession(PickInputs inputs);

  const PickInputs& inputs() const { return inputs_; }
  const PickableMesh& template_mesh() const { return template_; }
  const PickableMesh& scan_mesh() const { return scan_; }
  /// Up and front direction of the scanned head: from `PickInputs::hint`, or estimated.
  const PoseHint& scan_orientation() const { return scan_orientation_; }
  /// The landmarks as last read from the landmark file or last saved to it.
  std::vector<PickedLandmark> landmarks() const;
  /// Whether saving the landmark file would delete some of its comments. Saving keeps only comments
  /// at the start of the file.
  bool saving_deletes_comments() const;

  /// Returns the template's vertex nearest to the first point at which a ray hits the template;
  /// nothing if the ray misses the template.
  std::optional<PickedPlace> pick_on_template(const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction) const;
  /// Returns the first point at which a ray hits the scan; nothing if the ray misses the scan. The
  /// coordinates are rounded to a power of ten that is at most a millionth of the scan's size.
  std::optional<PickedPlace> pick_on_scan(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction) const;
  /// Suggests positions for landmarks that are not picked yet, see suggest_places.
  SuggestedPlaces suggest(const std::vector<PickedLandmark>& landmarks) const;

  /// Writes the landmark file. \throws UsageError if another program has changed the file since it
  /// was read or saved (a second call then overwrites it); CannotCreate, IoError.
  void save(const std::vector<PickedLandmark>& landmarks);

 private:
  /// Reads the landmark file; returns an empty text if there is no file.
  std::string landmark_file_text() const;

  PickInputs inputs_;
  PickableMesh template_, scan_;
  MirrorPlane symmetry_plane_;  ///< symmetry plane of the template
  /// maps landmark names to template vertices; see propose_landmarks
  std::map<std::string, std::uint32_t> proposed_vertices_;
  PoseHint scan_orientation_;
  /// Guards the members below.
  mutable std::mutex mutex_;
  std::vector<PickedLandmark> landmarks_;
  /// content of the landmark file when this object last read or wrote the file
  std::string last_file_text_;
};

}  // namespace crowdface

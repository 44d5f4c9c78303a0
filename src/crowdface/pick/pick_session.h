// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "crowdface/pick/landmark_file.h"
#include "crowdface/pick/pickable_mesh.h"
#include "crowdface/pick/suggested_places.h"
#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// What landmarks are picked on, and the file that they go to.
struct PickInputs {
  const WrapTemplate& shape;
  Positions positions;  ///< #V by 3 of the template, in millimetres
  Positions of_file;  ///< the same in its file's unit, which points in the file of landmarks are in
  Scan scan;
  std::optional<PoseHint> hint;  ///< how the scan stands; found if nothing is said
  std::filesystem::path template_file, scan_file, landmarks;
  /// A file whose landmarks of the template hold where `landmarks` has none; may be empty.
  std::filesystem::path of_template = {};
};

/// A template and a scan, ready to be pointed at; the landmarks' file.
class PickSession {
 public:
  /// Reads the file of landmarks, if it is there.
  /// \param inputs  its `shape` must outlive this object
  /// \throws Error naming what is wrong in the file, as wrapping would
  explicit PickSession(PickInputs inputs);

  const PickInputs& inputs() const { return inputs_; }
  const PickableMesh& of_template() const { return template_; }
  const PickableMesh& of_scan() const { return scan_; }
  /// Which way the head on the scan looks, as far as can be told.
  const PoseHint& scan_stands() const { return stands_; }
  /// What was read from the file, or saved last.
  std::vector<PickedLandmark> landmarks() const;
  /// Whether the file has comments that saving does not keep: those after its first lines.
  bool loses_comments() const;

  /// Points on the scan are rounded to a millionth of its size.
  std::optional<PickedPlace> pick_on_template(const Eigen::Vector3d& origin,
                                              const Eigen::Vector3d& direction) const;
  std::optional<PickedPlace> pick_on_scan(const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction) const;
  SuggestedPlaces suggest(const std::vector<PickedLandmark>& landmarks) const;

  /// Writes the file. \throws UsageError, once, if another program has changed it since it was read; CannotCreate,
  /// IoError.
  void save(const std::vector<PickedLandmark>& landmarks);

 private:
  std::string text_on_disk() const;

  PickInputs inputs_;
  PickableMesh template_, scan_;
  MirrorPlane plane_;
  std::map<std::string, std::uint32_t> proposals_;
  PoseHint stands_;
  mutable std::mutex mutex_;  ///< of what follows
  std::vector<PickedLandmark> landmarks_;
  std::string known_;  ///< what the file holds as far as we know
};

}  // namespace crowdface

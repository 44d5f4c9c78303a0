// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/pictures/attachment_surfaces.h"
#include "crowdface/pictures/shown_attachments.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Attachments of faces on the editor's page. Thread-safe.
class EditAttachments {
 public:
  /// \param job    must outlive this object.
  /// \param crowd  faces of the crowd, or null; must outlive this object.
  EditAttachments(const Job& job, const std::vector<FacePlan>* crowd);

  /// The names of the attachments of each kind.
  nlohmann::ordered_json kinds() const;
  /// Appearance of an attachment as JSON; nothing if no attachment has this name.
  /// \param name  see AttachmentLook::name.
  std::optional<std::string> look(const std::string& name) const;

  /// Whether attachments_of can answer at once: binding them to the heads takes a while.
  bool are_bound() const;
  /// The attachments of a face.
  /// \param face    the edited face; determines the attachments that are drawn for it
  /// \param opened  id of the crowd's face from which the edit began, whose attachments the face
  ///                keeps; or empty
  /// \param chosen  maps each kind to "draw", "none" or a name; missing kinds are drawn
  /// \throws UsageError if a kind or a name does not exist.
  std::vector<PlacedAttachment> attachments_of(const FacePlan& face, const std::string& opened,
                                               const nlohmann::ordered_json& chosen,
                                               const Positions& positions) const;
  /// Vertex positions of the attachment that `look` describes, three numbers for each vertex.
  std::vector<float> points(const PlacedAttachment& placed) const { return shown_.points(placed); }

 private:
  FacePlan drawn_for(const FacePlan& face, const std::string& opened) const;

  const Job& job_;
  const std::vector<FacePlan>* crowd_;
  /// Attachments bound to the heads; takes about a second to compute.
  std::shared_future<std::unique_ptr<const FaceAttachments>> bound_;
  AttachmentSurfaces surfaces_;
  ShownAttachments shown_;
};

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/pictures/attachment_surfaces.h"
#include "crowdface/pictures/shown_attachments.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Chooses the attachments of edited faces and makes the attachments' meshes for the editor's page.
/// Thread-safe.
class EditAttachments {
 public:
  /// \param job    must outlive this object.
  /// \param crowd  faces of the existing crowd, or null; must outlive this object.
  EditAttachments(const Job& job, const std::vector<FacePlan>* crowd);

  /// For each kind of attachments: the names of the attachments.
  nlohmann::ordered_json kinds() const;
  /// The triangles and the appearance of each material of an attachment, as JSON; nothing if no
  /// attachment has this name.
  /// \param name  see ColouredAttachment::name.
  std::optional<std::string> appearance_json(const std::string& name) const;

  /// The attachments of a face. Returns nothing while an attachment is being bound to the heads for
  /// the first time; binding takes seconds if there are expressions.
  /// \param face       the edited face; determines the attachments that are sampled for the face
  /// \param opened_id  id of the crowd's face from which the edit began, or empty. The edited face
  ///                   keeps the attachments of the crowd's face.
  /// \param chosen     maps each kind of attachments to "draw" (sampled), "none" or the name of an
  ///                   attachment; missing kinds are sampled
  /// \param positions  vertices of the face, without the displacements
  /// \param moves      displacements of the face's vertices, for example by expressions; the
  ///                   attachments follow the vertices
  /// \throws UsageError if a kind or a name does not exist.
  std::optional<std::vector<PlacedAttachment>> attachments_of(const FacePlan& face,
                                                              const std::string& opened_id,
                                                              const nlohmann::ordered_json& chosen,
                                                              const Positions& positions,
                                                              std::span<const Displacements> moves);
  /// Vertex positions of an attachment on a face, three numbers for each vertex, in the vertex
  /// order of appearance_json().
  std::vector<float> vertex_positions(const PlacedAttachment& placed) const {
    return shown_.vertex_positions(placed);
  }

 private:
  using BindingFuture = std::shared_future<std::unique_ptr<const FaceAttachments>>;

  /// Returns the binding of an attachment to the heads. The first call for an attachment starts a
  /// thread that computes the binding.
  BindingFuture binding(const std::string& name);
  /// Returns the plan from which the edited face gets its attachments and its hair colour. This is
  /// the plan of the crowd's face with the id `opened_id`. If the crowd has no face with this id,
  /// returns a copy of `face` with sampled attachments.
  FacePlan plan_with_attachments(const FacePlan& face, const std::string& opened_id) const;

  const Job& job_;
  const std::vector<FacePlan>* crowd_;  ///< faces of the existing crowd, or null
  std::mutex mutex_;
  /// Maps the name of an attachment to its binding. Contains only attachments that were requested.
  std::map<std::string, BindingFuture> bindings_;
  AttachmentSurfaces surfaces_;  ///< meshes and materials of the attachments
  ShownAttachments shown_;       ///< converts attachments to the data of the page
};

}  // namespace crowdface

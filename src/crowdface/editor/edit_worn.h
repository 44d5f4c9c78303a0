// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/heads/face_attachments.h"
#include "crowdface/pictures/shown_attachments.h"
#include "crowdface/pictures/worn_surfaces.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// What faces wear on the editor's page. Any thread may ask.
class EditWorn {
 public:
  /// \param job    must outlive this object.
  /// \param crowd  its faces, or null; likewise.
  EditWorn(const Job& job, const std::vector<CastFace>* crowd);

  /// The names of each kind.
  nlohmann::ordered_json kinds() const;
  /// How one looks, as JSON; nothing if there is none of that name.
  std::optional<std::string> look(const std::string& name) const;

  /// \param face    the one that is edited: what it would be given.
  /// \param opened  the face of the crowd that it was, whose attachments it has; or empty.
  /// \param chosen  by kind "draw", "none" or a name; kinds that it lacks are drawn.
  /// \throws UsageError if there is no such kind or name.
  std::vector<WornAttachment> worn_by(const CastFace& face, const std::string& opened,
                                      const nlohmann::ordered_json& chosen,
                                      const Positions& positions) const;
  /// Positions of what `look` tells of, three numbers a vertex.
  std::vector<float> points(const WornAttachment& worn) const { return shown_.points(worn); }

 private:
  std::vector<std::string> drawn_for(const CastFace& face, const std::string& opened) const;

  const Job& job_;
  const std::vector<CastFace>* crowd_;
  std::shared_future<std::unique_ptr<const FaceAttachments>> bound_;  ///< takes a second
  WornSurfaces surfaces_;
  ShownAttachments shown_;
};

}  // namespace crowdface

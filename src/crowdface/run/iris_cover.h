// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "crowdface/cast/face_plan.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/pictures/attachment_surfaces.h"
#include "crowdface/run/face_builder.h"

namespace crowdface {

/// Measures the fraction of an iris that is covered by hair, as seen from the front of the face.
/// Measures only attachments of the kind "hair" that come near an eye on the head for which they
/// were made. The heads need eyeballs as separate parts. Not thread-safe.
class IrisCover {
 public:
  /// Casting lets no face wear a haircut that covers a larger fraction of an iris.
  static constexpr double kMaxCoveredFraction = 0.1;

  /// \param builder      called once, when the first item has to be measured
  /// \param attachments  places the measured items on faces; must outlive this object.
  /// \param config, inputs  must outlive this object.
  IrisCover(const Config& config, const Inputs& inputs, FaceAttachments& attachments,
            std::function<const FaceBuilder&()> builder);

  /// Returns the fraction, 0 … 1, of an iris that the item covers on the finished face; the larger
  /// value of both eyes. Partly transparent hair counts in proportion to its opacity.
  double covered_fraction(const std::string& item, const FacePlan& face);

 private:
  /// An eyeball of a face.
  struct Eye {
    Eigen::Vector3d centre;  ///< centre of the eyeball, in the unit of the mesh files
    double radius;           ///< radius of the eyeball, in the unit of the mesh files
  };
  /// Returns the eyes of a mesh in the topology of the heads. \param positions  #V by 3
  std::vector<Eye> eyes_of(const Positions& positions) const;
  /// Returns the fraction, 0 … 1, of the eye's iris that the hair covers.
  double covered_fraction(const Eye& eye, const PlacedAttachment& hair) const;

  const Inputs& inputs_;
  HeadAxes axes_;  ///< directions up and front of the heads
  FaceAttachments& attachments_;
  std::function<const FaceBuilder&()> builder_;
  std::vector<std::string> items_near_eyes_;  ///< names of the attachments that can cover an iris
  AttachmentSurfaces surfaces_;               ///< meshes and opacities of the hair
  FaceBuilder::PreviousFace previous_face_;   ///< lets the builder reuse the previous face
};

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "crowdface/job/config.h"
#include "crowdface/job/crowd_directory.h"
#include "crowdface/job/inputs.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/face_renderer.h"

namespace crowdface {

/// Pictures of one crowd: one camera a view, fitted once to the input heads, so that sizes compare.
class CrowdRenders {
 public:
  CrowdRenders(const Config& config, const Config::ContactSheet& sheet, const Inputs& inputs);

  /// All views of a face side by side.
  Rgb8Image render(const Positions& positions, const VertexColours* colours = nullptr) const;
  /// The same as a PNG file's bytes.
  std::string render_png(const Positions& positions, const VertexColours* colours = nullptr) const;

 private:
  std::vector<Camera> cameras_;
  FaceRenderer renderer_;
};

/// Writes the contact sheets of a crowd, page by page, and removes pages of an earlier run that are
/// left over.
/// \param picture  the picture of the i-th id.
/// \return         how many pages.
std::size_t write_sheets(const CrowdDirectory& directory, const Config::ContactSheet& sheet,
                         const std::string& title, const std::vector<std::string>& ids,
                         const std::function<Rgb8Image(std::size_t)>& picture);

/// A picture written earlier, read back. \throws MissingInput, InvalidInput.
Rgb8Image read_render(const std::filesystem::path& path);

}  // namespace crowdface

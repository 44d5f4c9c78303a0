// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/page/answer_request.h"
#include "crowdface/page/local_server.h"
#include "crowdface/pick/pick_scans.h"

namespace crowdface {

/// Answers the HTTP requests of the page for picking landmarks.
class PickApi {
 public:
  /// \param scans          must outlive this object
  /// \param pages          folder with the HTML pages; nothing if they were not built
  /// \param max_triangles  maximum number of triangles of each mesh that the page shows
  PickApi(PickableScans& scans, std::optional<std::filesystem::path> pages,
          std::size_t max_triangles);

  /// Never throws because of the content of a request: the answer to a faulty request is {"error":
  /// sentence}.
  HttpAnswer answer(const HttpRequest& request);

 private:
  using Json = nlohmann::ordered_json;
  /// All data of the page except meshes: the list of scans, the orientations of the template and
  /// the open scan, and the landmarks.
  HttpAnswer page_data_answer(const PickSession& session) const;
  /// Opens the scan whose index is in the request's key `scan`.
  HttpAnswer open_scan(const Json& body);
  /// Returns a mesh reduced to at most `max_triangles_` triangles.
  /// \param shown  caches the reduced mesh for further requests
  HttpAnswer mesh_answer(const PickableMesh& whole, const ColourRows& colours,
                         ShownMesh& shown) const;

  PickableScans& scans_;
  PageFiles page_;
  std::size_t max_triangles_;
};

/// Serves the page for picking landmarks until a signal such as SIGINT arrives.
/// \param pages    folder with the HTML pages; nothing if they were not built
/// \param port     port of the server; 0: any free port
/// \param started  called with the address of the page once the server listens
/// \throws Error
void pick_landmarks(PickableScans& scans, std::optional<std::filesystem::path> pages, int port,
                    const std::function<void(const std::string&)>& started);

}  // namespace crowdface

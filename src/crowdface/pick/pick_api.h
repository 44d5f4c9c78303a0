// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/page/local_server.h"
#include "crowdface/page/page_files.h"
#include "crowdface/pick/pick_scans.h"

namespace crowdface {

/// What the page on which landmarks are picked asks for, answered.
class PickApi {
 public:
  /// \param scans           must outlive this object
  /// \param pages           the folder of built pages, if there is one
  /// \param most_triangles  of each mesh on the page
  PickApi(PickScans& scans, std::optional<std::filesystem::path> pages, std::size_t most_triangles);

  /// Never throws for what a request holds: mistakes are answers, {"error": sentence}.
  HttpAnswer answer(const HttpRequest& request);

 private:
  using Json = nlohmann::ordered_json;
  HttpAnswer job(const PickSession& session) const;
  HttpAnswer open(const Json& body);
  HttpAnswer mesh(const PickableMesh& whole, ShownMesh& shown) const;

  PickScans& scans_;
  PageFiles page_;
  std::size_t most_triangles_;
};

}  // namespace crowdface

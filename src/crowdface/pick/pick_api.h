// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/page/local_server.h"
#include "crowdface/page/page_files.h"
#include "crowdface/pick/pick_session.h"

namespace crowdface {

/// What the page on which landmarks are picked asks for, answered.
class PickApi {
 public:
  /// \param session         must outlive this object
  /// \param pages           the folder of built pages, if there is one
  /// \param most_triangles  of each mesh on the page
  PickApi(PickSession& session, std::optional<std::filesystem::path> pages,
          std::size_t most_triangles);

  /// Never throws for what a request holds: mistakes are answers, {"error": sentence}.
  HttpAnswer answer(const HttpRequest& request);

 private:
  using Json = nlohmann::ordered_json;
  HttpAnswer job() const;
  HttpAnswer pick(const Json& body) const;
  HttpAnswer suggest(const Json& body) const;
  HttpAnswer save(const Json& body);
  std::vector<PickedLandmark> landmarks_in(const Json& body) const;

  /// A mesh as the page shows it, made when it is first asked for.
  struct Shown {
    std::once_flag once;
    std::string bytes;
  };
  HttpAnswer mesh(const PickableMesh& whole, Shown& shown) const;

  PickSession& session_;
  PageFiles page_;
  std::size_t most_triangles_;
  Shown template_, scan_;
};

}  // namespace crowdface

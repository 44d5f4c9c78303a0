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

/// Serves the page on which landmarks are picked until a signal asks to end.
/// \param pages    the folder of built pages, if there is one
/// \param port     0: any that is free
/// \param started  is given the address once the page can be opened
/// \throws Error
void pick_landmarks(PickScans& scans, std::optional<std::filesystem::path> pages, int port,
                    const std::function<void(const std::string&)>& started);

}  // namespace crowdface

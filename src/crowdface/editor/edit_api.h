// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/editor/edit_session.h"
#include "crowdface/editor/local_server.h"

namespace crowdface {

/// What the editor's page asks for, answered (docs/editor.md).
class EditApi {
 public:
  /// \param session  must outlive this object
  explicit EditApi(EditSession& session);

  /// Never throws for what a request holds: mistakes are answers, {"error": sentence}.
  HttpAnswer answer(const HttpRequest& request);

 private:
  using Json = nlohmann::ordered_json;
  /// Answers requests of one method and address; of one that ends in '/', whatever follows it.
  struct Route {
    std::string method, path;
    HttpAnswer (EditApi::*answer)(const HttpRequest& request, const std::string& rest);
  };
  static const std::vector<Route>& routes();

  HttpAnswer page(const HttpRequest& request, const std::string& rest);
  HttpAnswer job(const HttpRequest& request, const std::string& rest);
  HttpAnswer mesh(const HttpRequest& request, const std::string& rest);
  HttpAnswer head(const HttpRequest& request, const std::string& rest);
  HttpAnswer face(const HttpRequest& request, const std::string& rest);

  CastFace face_of(const Json& request) const;
  void note_turn(const std::string& page, std::uint64_t turn);
  bool overtaken(const std::string& page, std::uint64_t turn);

  EditSession& session_;
  std::mutex building_;  ///< one face at a time, by all cores
  std::mutex turns_mutex_;
  std::map<std::string, std::uint64_t> turns_;  ///< the newest of each page
};

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace crowdface {

/// A request that passed the server's checks.
struct HttpRequest {
  std::string method;  ///< GET, POST or PUT
  std::string path;    ///< below the token, without its first slash: "api/job"
  std::string body;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::string bytes;
};

/// A server for one user on this machine. It listens on 127.0.0.1 alone, and whoever does not know the
/// random token that its address holds gets nothing; nor does a page of another site, whose requests
/// bear another Host or Origin. Bodies are bounded, and clients that do not go on are cut off.
class LocalServer {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{4} << 20U;  ///< of a body

  /// \param answer  is called from several threads.
  /// \param port    0: any that is free.
  /// \throws CannotCreate if it cannot be listened to.
  LocalServer(std::function<HttpAnswer(const HttpRequest&)> answer, int port);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  /// "http://127.0.0.1:PORT/TOKEN/".
  const std::string& address() const;
  /// Serves until `stop` returns true; it is asked ten times a second.
  void run(const std::function<bool()>& stop);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crowdface

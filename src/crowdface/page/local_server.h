// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace crowdface {

/// An HTTP request that passed the server's checks.
struct HttpRequest {
  std::string method;  ///< GET, POST or PUT
  std::string path;    ///< path after the token, without a leading slash: "api/job"
  std::string body;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";  ///< value of the header field Content-Type
  std::string bytes;                      ///< body of the answer
};

/// An HTTP/1.1 server for one user on this machine. It does not support ranges, chunked encoding or
/// compression. It listens on 127.0.0.1 only and answers only requests whose path starts with a
/// random token. It checks the Host and Origin headers and refuses requests from pages of other
/// sites. It limits the size and the transfer time of request heads and bodies, and the number of
/// connections, so a slow client does not delay other clients.
class LocalServer {
 public:
  /// Maximum size of the body of a request, in bytes.
  static constexpr std::size_t kMaxBodyBytes = std::size_t{4} << 20U;

  /// \param answer  computes the answer to a request; called from several threads.
  /// \param port    TCP port; 0: any free port.
  /// \throws CannotCreate if the server cannot listen on the port.
  LocalServer(std::function<HttpAnswer(const HttpRequest&)> answer, int port);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  /// The address of the page: "http://127.0.0.1:PORT/TOKEN/".
  const std::string& address() const;
  /// Serves requests until `stop` returns true. The server calls `stop` every 100 ms.
  void run(const std::function<bool()>& stop);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crowdface

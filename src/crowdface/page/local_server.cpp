// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/local_server.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <future>
#include <memory>
#include <system_error>
#include <thread>

#include <httplib.h>
#include <sys/random.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// 128 random bits from the operating system, as 32 hexadecimal digits.
std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw IoError("the system gives no random numbers");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += hex(byte, 2);
  return token;
}

/// Compares in constant time, so that the response time does not reveal a partly correct token.
bool is_same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return differences == 0;
}

/// Replaces the library's default, SO_REUSEPORT, which would let another program share the port.
void set_socket_options(socket_t socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
}

httplib::Headers safe_headers() {
  return {{"Content-Security-Policy",
           "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
           "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cross-Origin-Opener-Policy", "same-origin"},
          {"Cache-Control", "no-store"}};
}

void refuse(int status, const std::string& sentence, httplib::Response& response) {
  response.status = status;
  response.set_content(concat("{\"error\": \"", sentence, "\"}"), "application/json");
}

struct sigaction action_of_sigpipe() {
  struct sigaction action {};
  ::sigaction(SIGPIPE, nullptr, &action);
  return action;
}

/// Creates a thread pool that blocks SIGPIPE: writing to a closed connection fails instead of
/// raising the signal.
httplib::TaskQueue* make_threads() {
  constexpr int kThreads = 16;
  sigset_t pipe, before;
  ::sigemptyset(&pipe);
  ::sigaddset(&pipe, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &pipe, &before);  // the pool's threads inherit the mask
  auto pool = std::make_unique<httplib::ThreadPool>(kThreads);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return pool.release();
}

}  // namespace

struct LocalServer::State {
  /// The constructor of httplib::Server sets SIGPIPE to ignored for the whole process. Restores the
  /// host program's action.
  State() { ::sigaction(SIGPIPE, &of_host, nullptr); }

  const struct sigaction of_host = action_of_sigpipe();
  httplib::Server server;
  std::function<HttpAnswer(const HttpRequest&)> answer;
  std::string token = random_token();
  std::string prefix = "/" + token + "/";
  std::string address;
  /// Accepted values of the Host header.
  std::array<std::string, 2> hosts;

  void configure();
  bool passes(const httplib::Request& request, httplib::Response& response) const;
  bool comes_from_us(const httplib::Request& request) const;
};

bool LocalServer::State::comes_from_us(const httplib::Request& request) const {
  if (request.has_header("Origin")) {
    const std::string origin = request.get_header_value("Origin");
    return origin == "http://" + hosts[0] || origin == "http://" + hosts[1];
  }
  const bool reads = request.method == "GET" || request.method == "HEAD";
  return reads || request.get_header_value("Sec-Fetch-Site") == "same-origin";
}

/// Checks the headers of a request before its body is read.
bool LocalServer::State::passes(const httplib::Request& request,
                                httplib::Response& response) const {
  constexpr std::size_t kLongestPath = 512;
  const auto no = [&](int status, const char* sentence) {
    refuse(status, sentence, response);
    return false;
  };
  const std::string host = request.get_header_value("Host");
  if (request.get_header_value_count("Host") != 1 || (host != hosts[0] && host != hosts[1])) {
    return no(403, "the request is for another host");
  }
  if (!comes_from_us(request)) return no(403, "the request comes from another page");
  const bool writes = request.method == "POST" || request.method == "PUT";
  if (!writes && request.method != "GET" && request.method != "HEAD") {
    return no(405, "expected GET, POST or PUT");
  }
  if (request.path.size() > kLongestPath || !request.path.starts_with('/') ||
      !is_same(std::string_view(request.path).substr(0, prefix.size()), prefix)) {
    return no(404, "there is nothing at this address");
  }
  // The library limits the size of a body only if Content-Length is given.
  if (request.has_header("Transfer-Encoding") ||
      (writes && request.get_header_value_count("Content-Length") != 1)) {
    return no(411, "expected a body of a known length");
  }
  if (request.has_header("Content-Encoding")) return no(415, "expected a body that is not packed");
  return true;
}

void LocalServer::State::configure() {
  constexpr int kPatienceSeconds = 5;
  server.new_task_queue = make_threads;
  server.set_socket_options(set_socket_options);
  server.set_tcp_nodelay(true);
  server.set_default_headers(safe_headers());
  server.set_payload_max_length(kMostBytes);
  server.set_read_timeout(kPatienceSeconds);
  server.set_write_timeout(kPatienceSeconds);
  server.set_keep_alive_timeout(1);
  server.set_keep_alive_max_count(1000);
  server.set_pre_routing_handler(
      [this](const httplib::Request& request, httplib::Response& response) {
        return passes(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                         : httplib::Server::HandlerResponse::Handled;
      });
  const auto handle = [this](const httplib::Request& request, httplib::Response& response) {
    const std::string method = request.method == "HEAD" ? "GET" : request.method;
    const HttpAnswer given = answer({method, request.path.substr(prefix.size()), request.body});
    response.status = given.status;
    response.set_content(given.bytes, given.type);
  };
  server.Get("/.*", handle);
  server.Post("/.*", handle);
  server.Put("/.*", handle);
  server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (!response.body.empty()) return;
    const std::string sentence =
        response.status == 413 ? "the body is larger than 4 MiB" : "the request cannot be read";
    refuse(response.status, sentence, response);
  });
}

LocalServer::LocalServer(std::function<HttpAnswer(const HttpRequest&)> answer, int port)
    : state_(std::make_unique<State>()) {
  state_->answer = std::move(answer);
  state_->configure();
  constexpr const char* kHost = "127.0.0.1";
  const int bound = port == 0 ? state_->server.bind_to_any_port(kHost)
                              : (state_->server.bind_to_port(kHost, port) ? port : -1);
  if (bound <= 0) {
    throw CannotCreate(concat("port ", port, " of this machine cannot be listened to: ",
                              std::generic_category().message(errno),
                              "; choose another with --port"));
  }
  state_->hosts = {concat(kHost, ':', bound), concat("localhost:", bound)};
  state_->address = concat("http://", state_->hosts[0], state_->prefix);
}

LocalServer::~LocalServer() = default;

const std::string& LocalServer::address() const {
  return state_->address;
}

void LocalServer::run(const std::function<bool()>& stop) {
  constexpr auto kMoment = std::chrono::milliseconds(100);
  auto serving = std::async(std::launch::async, [this] { state_->server.listen_after_bind(); });
  while (!stop()) std::this_thread::sleep_for(kMoment);
  // The library ignores stop() until the server has started to listen.
  do {
    state_->server.stop();
  } while (serving.wait_for(kMoment) != std::future_status::ready);
}

}  // namespace crowdface

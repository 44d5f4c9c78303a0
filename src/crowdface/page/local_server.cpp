// SPDX-License-Identifier: Apache-2.0
// One thread reads all requests and writes all answers without blocking. A pool of threads computes
// the answers to complete requests. Therefore a client that is slow, or that does not know the
// token, occupies only its own connection and no thread.
#include "crowdface/page/local_server.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/random.h>
#include <sys/socket.h>

#include "crowdface/core/error.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/text.h"
#include "crowdface/page/http_head.h"

namespace crowdface {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxHeadBytes = std::size_t{16} << 10U, kMaxConnections = 64, kMaxAtOnce = 16,
                      kThreads = 16;
constexpr auto kPollInterval = std::chrono::milliseconds(100);
/// Time limits. kHeadTimeout: maximum time until the head of a request is complete, counted from
/// the first byte of the head. kBodyTimeout: maximum time until the body of a request is complete,
/// and maximum time until a client accepts more bytes of its answer.
constexpr auto kHeadTimeout = std::chrono::seconds(5), kBodyTimeout = std::chrono::seconds(60);

/// Returns 128 random bits from the operating system as 32 hexadecimal digits.
std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw IoError("the system gives no random numbers");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += hex(byte, 2);
  return token;
}

/// Compares two texts in constant time, so that the duration does not reveal the length of a
/// matching prefix.
bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return differences == 0;
}

HttpAnswer refuse(int status, std::string_view sentence) {
  return {status, "application/json", concat("{\"error\": \"", sentence, "\"}")};
}

std::string format_answer(const HttpAnswer& answer, bool with_body, bool closes) {
  static const std::map<int, std::string_view> reasons = {{200, "OK"},
                                                          {202, "Accepted"},
                                                          {400, "Bad Request"},
                                                          {403, "Forbidden"},
                                                          {404, "Not Found"},
                                                          {405, "Method Not Allowed"},
                                                          {409, "Conflict"},
                                                          {411, "Length Required"},
                                                          {413, "Content Too Large"},
                                                          {415, "Unsupported Media Type"},
                                                          {431, "Request Header Fields Too Large"}};
  const auto reason = reasons.find(answer.status);
  return concat(
      "HTTP/1.1 ", answer.status, ' ', reason == reasons.end() ? "Error" : reason->second,
      "\r\nContent-Type: ", answer.type, "\r\nContent-Length: ", answer.bytes.size(),
      "\r\nConnection: ", closes ? "close" : "keep-alive",
      "\r\nContent-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
      "img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer"
      "\r\nCross-Origin-Resource-Policy: same-origin\r\nCross-Origin-Opener-Policy: same-origin"
      "\r\nCache-Control: no-store\r\n\r\n",
      with_body ? answer.bytes : "");
}

struct Connection {
  enum class State {
    kReading,    ///< waits for a request or reads it
    kAnswering,  ///< a thread computes the answer
    kWriting,    ///< sends the answer
    /// The server has closed its sending side, and waits until the client has read the rest of the
    /// answer and closes the connection.
    kLeaving
  };
  explicit Connection(FileDescriptor accepted) : socket(std::move(accepted)) {}

  FileDescriptor socket;
  State state = State::kReading;
  std::string in, out;
  std::size_t sent = 0;
  std::optional<HttpHead> head;  ///< head of the request being read
  std::size_t head_bytes = 0, body_bytes = 0;
  bool closes = false;  ///< whether to close the connection after the answer
  /// While a request arrives: the time at which its head or body began. While an answer is sent:
  /// the time at which the client last accepted bytes.
  Clock::time_point since = Clock::now();
  /// the answer to the request, which a thread of the pool computes; guarded by State::mutex
  std::optional<HttpAnswer> answer;
};

}  // namespace

struct LocalServer::State {
  FileDescriptor listening{-1}, woken{-1};
  std::function<HttpAnswer(const HttpRequest&)> answer;
  std::string token = random_token();
  std::string prefix = "/" + token + "/";
  std::string address;
  std::array<std::string, 2> hosts;  ///< accepted values of the Host header

  std::list<Connection> connections;
  std::mutex mutex;
  std::condition_variable changed;
  /// connections whose requests have arrived completely and wait for an answer, with these
  /// requests; guarded by `mutex`
  std::deque<std::pair<Connection*, HttpRequest>> queued_requests;
  bool stopping = false;  ///< whether the server stops; guarded by `mutex`

  std::optional<HttpAnswer> refusal(const HttpHead& head) const;
  bool comes_from_us(const HttpHead& head) const;
  std::list<Connection>::iterator slowest_connection();
  bool is_full();
  void accept_clients();
  void read_from(Connection& client);
  void take_request(Connection& client);
  void give(const HttpAnswer& given, Connection& client);
  void write_to(Connection& client);
  bool is_over(const Connection& client) const;
  void serve_once();
  void work();
};

bool LocalServer::State::comes_from_us(const HttpHead& head) const {
  if (head.count("origin") > 1) return false;
  if (head.count("origin") == 1) {
    const std::string_view origin = head.value("origin");
    return origin == "http://" + hosts[0] || origin == "http://" + hosts[1];
  }
  const bool reads = head.method == "GET" || head.method == "HEAD";
  return reads || head.value("sec-fetch-site") == "same-origin";
}

/// Checks the head of a request before the body is read. Returns an error answer if the server
/// refuses the request; otherwise nothing.
std::optional<HttpAnswer> LocalServer::State::refusal(const HttpHead& head) const {
  constexpr std::size_t kLongestPath = 512;
  const std::string_view host = head.value("host");
  if (head.count("host") != 1 || (host != hosts[0] && host != hosts[1])) {
    return refuse(403, "the request is for another host");
  }
  if (!comes_from_us(head)) return refuse(403, "the request comes from another page");
  const bool writes = head.method == "POST" || head.method == "PUT";
  if (!writes && head.method != "GET" && head.method != "HEAD") {
    return refuse(405, "expected GET, POST or PUT");
  }
  if (head.path.size() > kLongestPath ||
      !equal_in_constant_time(std::string_view(head.path).substr(0, prefix.size()), prefix)) {
    return refuse(404, "there is nothing at this address");
  }
  const std::size_t lengths = head.count("content-length");
  const auto length = parse_unsigned(head.value("content-length"));
  if (head.count("transfer-encoding") > 0 || lengths > 1 || (writes && lengths == 0) ||
      (lengths == 1 && !length)) {
    return refuse(411, "expected a body of a known length");
  }
  if (head.count("content-encoding") > 0) return refuse(415, "expected a body without compression");
  if (length.value_or(0) > kMaxBodyBytes) return refuse(413, "the body is larger than 4 MiB");
  return std::nullopt;
}

/// Returns the connection to close in favour of a new client. This is the connection whose request
/// head has been incomplete for the longest time, if this time exceeds kPollInterval; otherwise
/// end().
std::list<Connection>::iterator LocalServer::State::slowest_connection() {
  auto oldest = connections.end();
  for (auto client = connections.begin(); client != connections.end(); ++client) {
    const bool may_go = client->state == Connection::State::kReading && !client->head &&
                        Clock::now() - client->since > kPollInterval;
    if (may_go && (oldest == connections.end() || client->since < oldest->since)) oldest = client;
  }
  return oldest;
}

bool LocalServer::State::is_full() {
  return connections.size() >= kMaxConnections && slowest_connection() == connections.end();
}

/// Accepts some of the waiting clients. If there are too many connections, closes the slowest
/// connection. Reads from each new client immediately, so that a client whose request has arrived
/// is not closed in favour of later clients.
void LocalServer::State::accept_clients() {
  for (std::size_t i = 0; i < kMaxAtOnce && !is_full(); ++i) {
    FileDescriptor accepted(
        ::accept4(listening.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    const bool is_short = !accepted.valid() && is_system_error(errno);
    if (!accepted.valid() && !is_short) return;
    if (is_short || connections.size() >= kMaxConnections) {
      const auto oldest = slowest_connection();
      if (oldest == connections.end()) return;
      connections.erase(oldest);
    }
    if (is_short) return;
    const int yes = 1;
    ::setsockopt(accepted.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    read_from(connections.emplace_back(std::move(accepted)));
  }
}

void LocalServer::State::read_from(Connection& client) {
  std::array<char, std::size_t{64} << 10U> bytes;
  const ssize_t got = ::recv(client.socket.get(), bytes.data(), bytes.size(), 0);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (got <= 0) {
    client.socket = FileDescriptor(-1);
    return;
  }
  if (client.state == Connection::State::kLeaving) return;
  if (client.in.empty()) client.since = Clock::now();
  client.in.append(bytes.data(), static_cast<std::size_t>(got));
  take_request(client);
}

/// Processes the received part of an HTTP request. Parses the HTTP head (request line and header
/// fields) when it is complete, and queues the request when its body is complete too.
void LocalServer::State::take_request(Connection& client) {
  if (!client.head) {
    constexpr std::string_view kEnd = "\r\n\r\n";
    const std::size_t end = client.in.find(kEnd);
    client.closes = true;
    if (std::min(end, client.in.size()) > kMaxHeadBytes) {
      return give(refuse(431, "the head of the request is larger than 16 KiB"), client);
    }
    if (end == std::string::npos) return;
    client.head_bytes = end + kEnd.size();
    client.head = parse_http_head(std::string_view(client.in).substr(0, client.head_bytes));
    if (!client.head) return give(refuse(400, "the request cannot be read"), client);
    if (const auto refused = refusal(*client.head)) return give(*refused, client);
    client.body_bytes = parse_unsigned(client.head->value("content-length")).value_or(0);
    client.closes = client.head->closes_connection;
    client.since = Clock::now();
  }
  if (client.in.size() < client.head_bytes + client.body_bytes) return;
  HttpRequest request{client.head->method == "HEAD" ? "GET" : client.head->method,
                      client.head->path.substr(prefix.size()),
                      client.in.substr(client.head_bytes, client.body_bytes)};
  client.in.erase(0, client.head_bytes + client.body_bytes);
  client.state = Connection::State::kAnswering;
  const std::lock_guard lock(mutex);
  queued_requests.emplace_back(&client, std::move(request));
  changed.notify_one();
}

void LocalServer::State::give(const HttpAnswer& given, Connection& client) {
  const bool with_body = !client.head || client.head->method != "HEAD";
  client.out = format_answer(given, with_body, client.closes);
  client.sent = 0;
  client.head.reset();
  client.state = Connection::State::kWriting;
  client.since = Clock::now();
}

void LocalServer::State::write_to(Connection& client) {
  const ssize_t written = ::send(client.socket.get(), client.out.data() + client.sent,
                                 client.out.size() - client.sent, MSG_NOSIGNAL);
  if (written < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (written < 0) {
    client.socket = FileDescriptor(-1);
    return;
  }
  client.sent += static_cast<std::size_t>(written);
  client.since = Clock::now();
  if (client.sent < client.out.size()) return;
  client.out.clear();
  client.state = Connection::State::kReading;
  if (client.closes) {
    ::shutdown(client.socket.get(), SHUT_WR);
    client.state = Connection::State::kLeaving;
    client.in.clear();
  } else if (!client.in.empty()) {
    take_request(client);
  }
}

bool LocalServer::State::is_over(const Connection& client) const {
  if (client.state == Connection::State::kAnswering) return false;
  const auto patience = client.head ? kBodyTimeout : kHeadTimeout;
  return !client.socket.valid() || Clock::now() - client.since > patience;
}

/// Waits for events, at most kPollInterval. Then handles the events; the handling never waits.
void LocalServer::State::serve_once() {
  const short new_clients = is_full() ? 0 : POLLIN;
  std::vector<pollfd> waiting = {{listening.get(), new_clients, 0}, {woken.get(), POLLIN, 0}};
  std::vector<Connection*> clients;
  for (Connection& client : connections) {
    if (client.state == Connection::State::kAnswering) continue;
    const bool writes = client.state == Connection::State::kWriting;
    waiting.push_back({client.socket.get(), static_cast<short>(writes ? POLLOUT : POLLIN), 0});
    clients.push_back(&client);
  }
  if (::poll(waiting.data(), waiting.size(), static_cast<int>(kPollInterval.count())) < 0) return;
  for (std::size_t c = 0; c < clients.size(); ++c) {
    if (waiting[c + 2].revents == 0) continue;
    clients[c]->state == Connection::State::kWriting ? write_to(*clients[c])
                                                     : read_from(*clients[c]);
  }
  if (waiting[1].revents != 0) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(woken.get(), &count, sizeof count);
    const std::lock_guard lock(mutex);
    for (Connection& client : connections) {
      if (client.answer) give(*std::exchange(client.answer, std::nullopt), client);
    }
  }
  std::erase_if(connections, [&](const Connection& client) { return is_over(client); });
  if (waiting[0].revents != 0) accept_clients();
}

/// Computes the answers to queued requests until the server stops. Each thread of the pool runs
/// this function.
void LocalServer::State::work() {
  for (;;) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return stopping || !queued_requests.empty(); });
    if (stopping) return;
    auto [client, request] = std::move(queued_requests.front());
    queued_requests.pop_front();
    lock.unlock();
    HttpAnswer given = answer(request);
    lock.lock();
    client->answer = std::move(given);
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(woken.get(), &one, sizeof one);
  }
}

LocalServer::LocalServer(std::function<HttpAnswer(const HttpRequest&)> answer, int port)
    : state_(std::make_unique<State>()) {
  state_->answer = std::move(answer);
  state_->woken = FileDescriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  state_->listening =
      FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int socket = state_->listening.get(), yes = 1;
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(static_cast<std::uint16_t>(port));
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  auto* address = reinterpret_cast<sockaddr*>(&here);
  // SO_REUSEADDR allows the server to restart on the same port. It does not allow two servers to
  // use one port at the same time.
  if (!state_->woken.valid() || socket < 0 ||
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(socket, address, size) != 0 || ::listen(socket, SOMAXCONN) != 0 ||
      ::getsockname(socket, address, &size) != 0) {
    throw CannotCreate(concat("cannot listen on port ", port, " of this machine: ", errno_message(),
                              "; choose another with --port"));
  }
  const int bound = ntohs(here.sin_port);
  state_->hosts = {concat("127.0.0.1:", bound), concat("localhost:", bound)};
  state_->address = concat("http://", state_->hosts[0], state_->prefix);
}

LocalServer::~LocalServer() = default;

const std::string& LocalServer::address() const {
  return state_->address;
}

void LocalServer::run(const std::function<bool()>& stop) {
  std::list<std::jthread> threads;
  const auto end = [&] {
    const std::lock_guard lock(state_->mutex);
    state_->stopping = true;
    state_->changed.notify_all();
  };
  try {
    while (threads.size() < kThreads) threads.emplace_back([this] { state_->work(); });
    while (!stop()) state_->serve_once();
  } catch (...) {
    end();
    throw;
  }
  end();
}

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/local_server.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <list>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "crowdface/core/error.h"

#include "support/expect_error.h"
#include "support/raw_client.h"

namespace crowdface {
namespace {

using testing::RawClient;

/// A server that tells what it was asked for.
class LocalServerTest : public ::testing::Test {
 protected:
  LocalServerTest()
      : server_(
            [this](const HttpRequest& request) {
              ++answered_;
              return HttpAnswer{200, "text/plain",
                                request.method + ' ' + request.path + ' ' + request.body};
            },
            0) {
    const std::string address = server_.address();
    const std::size_t slash = address.find('/', 7);
    host_ = address.substr(7, slash - 7);
    path_ = address.substr(slash);
    thread_ = std::thread([this] { server_.run([this] { return stop_.load(); }); });
  }
  ~LocalServerTest() override {
    stop_ = true;
    thread_.join();
  }
  httplib::Client client() const { return httplib::Client("http://" + host_); }
  httplib::Headers ours() const { return {{"Origin", "http://" + host_}}; }
  int port() const { return std::stoi(host_.substr(host_.find(':') + 1)); }

  std::atomic<int> answered_ = 0;
  std::string host_, path_;

 private:
  std::atomic<bool> stop_ = false;
  LocalServer server_;
  std::thread thread_;
};

TEST_F(LocalServerTest, AnswersItsOwnPage) {
  const auto got = client().Get(path_ + "api/job");
  ASSERT_TRUE(got);
  EXPECT_EQ(got->body, "GET api/job ");
  EXPECT_EQ(got->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(got->get_header_value("Content-Security-Policy").find("default-src 'none'"), 0U);
  EXPECT_EQ(client().Post(path_ + "api/face", ours(), "{}", "application/json")->body,
            "POST api/face {}");
  EXPECT_EQ(client()
                .Put(path_ + "api/state", {{"Sec-Fetch-Site", "same-origin"}}, "1", "text/plain")
                ->body,
            "PUT api/state 1");
}

TEST_F(LocalServerTest, KnowsNobodyWithoutTheToken) {
  std::string other = path_;
  other[5] = other[5] == 'a' ? 'b' : 'a';
  for (const std::string& path :
       {std::string("/"), std::string("/api/job"), other, other + "api/job",
        path_.substr(0, path_.size() - 1), "/x" + path_}) {
    EXPECT_EQ(client().Get(path)->status, 404) << path;
  }
  EXPECT_EQ(answered_, 0);
}

TEST_F(LocalServerTest, RefusesOtherHosts) {
  for (const std::string& host :
       {std::string("evil.example"), host_ + "0", "localhost.evil:" + std::to_string(port()),
        std::string("127.0.0.1")}) {
    EXPECT_EQ(client().Get(path_, {{"Host", host}})->status, 403) << host;
  }
  EXPECT_EQ(answered_, 0);
  EXPECT_EQ(client().Get(path_, {{"Host", "localhost:" + std::to_string(port())}})->status, 200);
}

TEST_F(LocalServerTest, RefusesOtherPages) {
  const auto post = [&](const httplib::Headers& headers) {
    return client().Post(path_, headers, "{}", "application/json")->status;
  };
  EXPECT_EQ(post({}), 403);
  EXPECT_EQ(post({{"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(post({{"Origin", "null"}}), 403);
  EXPECT_EQ(post({{"Origin", "https://" + host_}}), 403);
  EXPECT_EQ(post({{"Sec-Fetch-Site", "same-site"}}), 403);
  EXPECT_EQ(client().Get(path_, {{"Origin", "http://evil.example"}})->status, 403);
  EXPECT_EQ(answered_, 0);
  EXPECT_EQ(post(ours()), 200);
}

TEST_F(LocalServerTest, BoundsWhatItReads) {
  const std::string large(LocalServer::kMaxBodyBytes + 1, 'x');
  const auto got = client().Post(path_, ours(), large, "text/plain");
  if (got) {  // or the connection is cut
    EXPECT_EQ(got->status, 413);
  }
  httplib::Headers packed = ours();
  packed.emplace("Content-Encoding", "gzip");
  EXPECT_EQ(client().Post(path_, packed, "x", "text/plain")->status, 415);
  const auto pieces = client().Post(
      path_, ours(), [](std::size_t, httplib::DataSink& sink) { return sink.done(), true; },
      "text/plain");
  if (pieces) {
    EXPECT_EQ(pieces->status, 411);
  }
  EXPECT_EQ(client().Get(path_ + std::string(600, 'a'))->status, 404);
  EXPECT_EQ(client().Delete(path_, ours())->status, 405);
  EXPECT_EQ(answered_, 0);
}

// The server ignored SIGPIPE for the whole process of its host.
TEST_F(LocalServerTest, LeavesSigpipeToTheHostAndOutlivesReadersWhoLeave) {
  struct sigaction action {};
  ASSERT_EQ(::sigaction(SIGPIPE, nullptr, &action), 0);
  EXPECT_EQ(action.sa_handler, SIG_DFL);
  for (int i = 0; i < 50; ++i) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_port = htons(static_cast<std::uint16_t>(port()));
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&there), sizeof(there)), 0);
    std::string requests;
    for (int k = 0; k < 20; ++k) {
      requests += "GET " + path_ + "api/job HTTP/1.1\r\nHost: " + host_ + "\r\n\r\n";
    }
    EXPECT_GT(::send(socket, requests.data(), requests.size(), MSG_NOSIGNAL), 0);
    const linger at_once = {1, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
    ::close(socket);
  }
  EXPECT_TRUE(client().Get(path_ + "api/job"));
}

// Seventeen such clients kept everybody else waiting.
TEST_F(LocalServerTest, SlowClientsHoldNobodyUp) {
  std::list<RawClient> slow;
  for (int i = 0; i < 200; ++i) {
    slow.emplace_back(port()).say("GET / HTTP/1.1\r\nHost: ");
    if (i % 50 == 17) {
      for (RawClient& client : slow) client.say("x");
      const auto start = std::chrono::steady_clock::now();
      const auto got = client().Get(path_ + "api/state");
      ASSERT_TRUE(got) << i;
      EXPECT_EQ(got->status, 200);
      EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
    }
  }
}

// Where more clients came at once than the server serves, it hung up on those whose request was there already.
TEST_F(LocalServerTest, AFloodOfClientsHoldsNobodyUp) {
  std::atomic<bool> done = false;
  std::list<std::jthread> floods;
  for (int i = 0; i < 3; ++i) {
    floods.emplace_back([&] {
      std::list<RawClient> clients;
      while (!done) {
        if (clients.size() > 100) clients.pop_front();
        clients.emplace_back(port()).say("GET / HTTP/1.1\r\n");
      }
    });
  }
  const std::string body(1 << 20, 'x');
  for (int i = 0; i < 50; ++i) {
    const auto got = client().Post(path_, ours(), body, "text/plain");
    EXPECT_TRUE(got && got->status == 200) << i;
  }
  done = true;
}

// Header lines without an end took 1.2 GB.
TEST_F(LocalServerTest, BoundsTheHeadOfARequestAndItsTime) {
  const RawClient endless(port());
  const std::string line = "X-Some: " + std::string(1000, 'a') + "\r\n";
  endless.say("GET / HTTP/1.1\r\n");
  auto start = std::chrono::steady_clock::now();
  const auto is_soon = [&] {
    return std::chrono::steady_clock::now() - start < std::chrono::seconds(20);
  };
  while (endless.say(line) && is_soon()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(is_soon()) << "nobody closed the connection";
  const RawClient late(port());
  start = std::chrono::steady_clock::now();
  bool is_open = true;
  for (const char c : "GET / HTTP/1.1\r\nHost: nobody") {
    is_open = is_open && late.say({&c, 1});
    if (is_open) std::this_thread::sleep_for(std::chrono::milliseconds(400));
  }
  EXPECT_FALSE(is_open);
  EXPECT_TRUE(is_soon());
}

TEST_F(LocalServerTest, RefusesWhatIsNoRequest) {
  const std::string host = "Host: " + host_ + "\r\n", get = "GET " + path_ + "a HTTP/1.1\r\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"\r\n\r\n", "400"},
      {"GET\r\n\r\n", "400"},
      {"GET " + path_ + " HTTP/3\r\n" + host + "\r\n", "400"},
      {"GET " + path_ + "%zz HTTP/1.1\r\n" + host + "\r\n", "400"},
      {"GET " + path_ + "%00 HTTP/1.1\r\n" + host + "\r\n", "400"},
      {"GET " + path_ + "a b HTTP/1.1\r\n" + host + "\r\n", "400"},
      {get + host + "no colon\r\n\r\n", "400"},
      {get + host + " folded: x\r\n\r\n", "400"},
      {get + host + "A: x\x01\r\n\r\n", "400"},
      {get + "\r\n", "403"},
      {get + host + host + "\r\n", "403"},
      {get + host + "Origin: http://" + host_ + "\r\nOrigin: http://evil.example\r\n\r\n", "403"},
      {get + host + "Origin: http://" + host_ + "\r\nOrigin: http://" + host_ + "\r\n\r\n", "403"},
      {get + host + "Content-Length: 1\r\nContent-Length: 2\r\n\r\n", "411"},
      {get + host + "Content-Length: -1\r\n\r\n", "411"},
      {get + host + "Content-Length: 99999999999999999999\r\n\r\n", "411"},
      {get + host + "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n", "411"},
      {get + host + "A: " + std::string(20000, 'a') + "\r\n\r\n", "431"}};
  for (const auto& [text, status] : cases) {
    const RawClient client(port());
    client.say(text);
    EXPECT_EQ(client.hear().substr(0, 12), "HTTP/1.1 " + status) << text.substr(0, 200);
  }
  EXPECT_EQ(answered_, 0);
}

// A request of 4 kB for many ranges gave 56 MB.
TEST_F(LocalServerTest, GivesNoRanges) {
  std::string ranges = "bytes=0-";
  for (int i = 0; i < 500; ++i) ranges += ",0-";
  const auto got = client().Get(path_ + "api/job", {{"Range", ranges}});
  ASSERT_TRUE(got);
  EXPECT_EQ(got->status, 200);
  EXPECT_EQ(got->body, "GET api/job ");
}

TEST_F(LocalServerTest, AnswersSeveralRequestsOfAConnectionInTheirOrder) {
  const RawClient client(port());
  std::string requests;
  for (int i = 0; i < 50; ++i) {
    requests += "POST " + path_ + std::to_string(i) + " HTTP/1.1\r\nHost: " + host_ +
                "\r\nOrigin: http://" + host_ + "\r\nContent-Length: 3\r\n" +
                (i == 49 ? "Connection: close\r\n" : "") + "\r\na\r\n";
  }
  client.say(requests);
  const std::string heard = client.hear();
  std::size_t at = 0;
  for (int i = 0; i < 50; ++i) {
    at = heard.find("POST " + std::to_string(i) + " a\r\n", at);
    ASSERT_NE(at, std::string::npos) << i;
  }
  EXPECT_EQ(answered_, 50);
}

// Three clients that sent a byte now and then kept the program from ending for half a minute.
TEST(LocalServer, EndsWithinASecondWhateverIsConnected) {
  std::atomic<bool> stop = false;
  LocalServer server(
      [](const HttpRequest&) {
        return HttpAnswer{200, "text/plain", std::string(16 << 20, 'x')};
      },
      0);
  std::thread thread([&] { server.run([&] { return stop.load(); }); });
  const std::string address = server.address();
  const std::size_t slash = address.find('/', 7);
  const std::string host = address.substr(7, slash - 7);
  const int port = std::stoi(host.substr(host.find(':') + 1));
  std::list<RawClient> clients;
  for (int i = 0; i < 20; ++i) clients.emplace_back(port).say("GET /");
  for (int i = 0; i < 3; ++i) {  // that read nothing
    clients.emplace_back(port).say("GET " + address.substr(slash) + " HTTP/1.1\r\nHost: " + host +
                                   "\r\n\r\n");
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const auto start = std::chrono::steady_clock::now();
  stop = true;
  thread.join();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST_F(LocalServerTest, SharesItsPortWithNobody) {
  testing::expect_error(ExitCode::kCannotCreate, {"port " + std::to_string(port()), "--port"}, [&] {
    const LocalServer second([](const HttpRequest&) { return HttpAnswer{}; }, port());
  });
}

}  // namespace
}  // namespace crowdface

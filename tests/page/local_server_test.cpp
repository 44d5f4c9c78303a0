// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/local_server.h"

#include <atomic>
#include <csignal>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "crowdface/core/error.h"

#include "support/expect_error.h"

namespace crowdface {
namespace {

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
  const std::string large(LocalServer::kMostBytes + 1, 'x');
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

TEST_F(LocalServerTest, SharesItsPortWithNobody) {
  testing::expect_error(ExitCode::kCannotCreate, {"port " + std::to_string(port()), "--port"}, [&] {
    const LocalServer second([](const HttpRequest&) { return HttpAnswer{}; }, port());
  });
}

}  // namespace
}  // namespace crowdface

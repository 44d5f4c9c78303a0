// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/page/answer_request.h"

#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

TEST(PageFiles, AreThoseOfThePageAndNoOthers) {
  const TemporaryFolder folder;
  for (const char* name : {"pick.html", "pick.js", "editor.js", "secret.txt"}) {
    folder.write(name, name);
  }
  const PageFiles files(folder.path(), "pick");
  EXPECT_EQ(files.file("")->bytes, "pick.html");
  EXPECT_EQ(files.file("")->type, "text/html; charset=utf-8");
  EXPECT_EQ(files.file("pick.js")->type, "text/javascript; charset=utf-8");
  for (const char* name :
       {"pick.css", "editor.js", "secret.txt", "../pick.html", "/etc/hostname"}) {
    EXPECT_FALSE(files.file(name)) << name;
  }
}

TEST(PageFiles, ANoticeStandsWhereThePageIsNotBuilt) {
  const TemporaryFolder folder;
  for (const PageFiles& files : {PageFiles(folder.path(), "pick"), PageFiles({}, "pick")}) {
    EXPECT_THAT(files.file("")->bytes, ::testing::HasSubstr("scripts/build_gallery.sh"));
    EXPECT_FALSE(files.file("pick.js"));
  }
}

TEST(AnswerRequest, MistakesAreAnswers) {
  const HttpRequest request{"GET", "api/job", ""};
  const auto answer = [&](const auto& act) {
    return answer_or_error(request, [&](const HttpRequest&) -> HttpAnswer { return act(); });
  };
  const HttpAnswer usage = answer([]() -> HttpAnswer { throw UsageError("the \"name\""); });
  EXPECT_EQ(usage.status, 400);
  EXPECT_EQ(usage.bytes, R"({"error":"the \"name\""})");
  EXPECT_EQ(answer([]() -> HttpAnswer { throw MissingInput("m"); }).status, 404);
  EXPECT_EQ(answer([]() -> HttpAnswer { throw CannotCreate("c"); }).status, 500);
  const HttpAnswer ours = answer([]() -> HttpAnswer { throw std::out_of_range("internals"); });
  EXPECT_EQ(ours.status, 500);
  EXPECT_THAT(ours.bytes, ::testing::Not(::testing::HasSubstr("internals")));
}

}  // namespace
}  // namespace crowdface::testing

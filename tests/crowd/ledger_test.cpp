// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/ledger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::read_text;
using testing::TemporaryFolder;

LedgerEntry some_entry() {
  return {"faces/mob_0001",
          hash_bytes("key"),
          {{"meshes/mob_0001.obj", {5, hash_bytes("bytes")}}, {"renders/“ä”.png", {0, {}}}},
          R"({"stretch":1.25,"flipped":3})"};
}

void expect_equal(const LedgerEntry& a, const LedgerEntry& b) {
  EXPECT_EQ(a.item, b.item);
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.note, b.note);
  ASSERT_EQ(a.files.size(), b.files.size());
  for (std::size_t f = 0; f < a.files.size(); ++f) {
    EXPECT_EQ(a.files[f].name, b.files[f].name);
    EXPECT_EQ(a.files[f].content, b.files[f].content);
  }
}

TEST(LedgerLine, ReadsBack) {
  const LedgerEntry entry = some_entry();
  const std::string line = format_ledger_line(entry);
  EXPECT_EQ(line.find('\n'), line.npos);
  const auto read = parse_ledger_line(line);
  ASSERT_TRUE(read);
  expect_equal(*read, entry);
}

TEST(LedgerLine, CutOrAlteredAnywhereIsNoLine) {
  const std::string line = format_ledger_line(some_entry());
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_FALSE(parse_ledger_line(line.substr(0, i))) << i;
    EXPECT_FALSE(parse_ledger_line(line.substr(i + 1))) << i;
    for (const int bit : {0, 3, 7}) {
      std::string altered = line;
      altered[i] = static_cast<char>(altered[i] ^ (1 << bit));
      EXPECT_FALSE(parse_ledger_line(altered)) << i;
    }
  }
  EXPECT_FALSE(parse_ledger_line(line + " "));
  EXPECT_FALSE(parse_ledger_line(line + line));
}

/// A ledger in a folder with one file.
class LedgerOfAFolder : public ::testing::Test {
 protected:
  fs::path path() const { return folder_ / "ledger.jsonl"; }
  Ledger open() const { return {folder_.path(), path(), {}}; }
  Digest key_ = hash_bytes("key");
  TemporaryFolder folder_;
};

TEST_F(LedgerOfAFolder, ProvesWhatWasRecordedAndIsAsItWas) {
  folder_.write("a.txt", "text");
  {
    Ledger ledger = open();
    EXPECT_FALSE(ledger.find_verified("a", key_));
    ledger.record("a", key_, {"a.txt"});
    EXPECT_TRUE(ledger.find_verified("a", key_));
  }
  EXPECT_TRUE(open().find_verified("a", key_)) << "by another run";
  EXPECT_FALSE(open().find_verified("a", hash_bytes("other key")));
  folder_.write("a.txt", "Text");
  EXPECT_FALSE(open().find_verified("a", key_)) << "other bytes";
  folder_.write("a.txt", "text and more");
  EXPECT_FALSE(open().find_verified("a", key_));
  fs::remove(folder_ / "a.txt");
  EXPECT_FALSE(open().find_verified("a", key_));
  fs::create_directory(folder_ / "a.txt");
  EXPECT_FALSE(open().find_verified("a", key_));
}

TEST_F(LedgerOfAFolder, ALineWithoutItsEndProvesNothingAndSpoilsNoOther) {
  folder_.write("a.txt", "a");
  folder_.write("b.txt", "b");
  {
    Ledger ledger = open();
    ledger.record("a", key_, {"a.txt"});
    ledger.record("b", key_, {"b.txt"});
  }
  const std::string whole = read_text(path());
  for (std::size_t size = whole.find('\n') + 1; size < whole.size(); ++size) {
    folder_.write("ledger.jsonl", whole.substr(0, size));
    Ledger ledger = open();
    EXPECT_TRUE(ledger.find_verified("a", key_));
    EXPECT_FALSE(ledger.find_verified("b", key_)) << size;
    ledger.record("b", key_, {"b.txt"});
    EXPECT_EQ(read_text(path()), whole);
  }
}

TEST_F(LedgerOfAFolder, WritesOnlyWhatIsNotThere) {
  Ledger ledger = open();
  ledger.write("a.txt", "one");
  EXPECT_EQ(read_text(folder_ / "a.txt"), "one");
  fs::last_write_time(folder_ / "a.txt", fs::file_time_type());
  ledger.write("a.txt", "one");
  fs::remove(path());
  open().write("a.txt", "one");
  EXPECT_EQ(fs::last_write_time(folder_ / "a.txt"), fs::file_time_type());
  ledger.write("a.txt", "two");
  EXPECT_EQ(read_text(folder_ / "a.txt"), "two");
}

TEST_F(LedgerOfAFolder, SettledHoldsWhatThisRunUsedInOneOrder) {
  for (const char* name : {"a", "b", "c"}) folder_.write(name, name);
  const fs::path shard = folder_ / "ledger-2of3.jsonl";
  Ledger(folder_.path(), shard, {}).record("b", key_, {"b"});
  {
    Ledger ledger(folder_.path(), path(), {shard});
    ledger.record("c", key_, {"c"});
    ledger.record("old", key_, {"a"});
  }
  Ledger ledger(folder_.path(), path(), {shard});
  EXPECT_TRUE(ledger.find_verified("c", key_));
  EXPECT_TRUE(ledger.find_verified("b", key_)) << "the shard's";
  ledger.record("a", key_, {"a"});
  ledger.compact();
  EXPECT_FALSE(fs::exists(shard));
  std::vector<std::string> items;
  for (const LedgerEntry& entry : read_ledger(path()).entries) items.push_back(entry.item);
  EXPECT_THAT(items, ::testing::ElementsAre("a", "b", "c"));
}

TEST_F(LedgerOfAFolder, FinishedKnowsHowManyFilesOfEachKindThereAre) {
  folder_.write("meshes/a.obj", "a");
  folder_.write("sheets/s.png", "s");
  folder_.write("sheets/t.png", "t");
  const fs::path own = folder_ / "ledger.jsonl";
  Ledger ledger(folder_.path(), own, {});
  ledger.record("faces/a", {}, {"meshes/a.obj"});
  ledger.record("sheets", {}, {"sheets/s.png", "sheets/t.png"});
  ledger.write("plan.jsonl", "plan");
  ledger.compact();
  EXPECT_TRUE(read_ledger(own).is_complete);
  const std::string text = testing::read_text(own);
  EXPECT_NE(text.find(R"("note":{".":1,"meshes":1,"sheets":2})"), text.npos) << text;
  EXPECT_NO_THROW(ledger.require_files());
  fs::remove(folder_ / "sheets/t.png");
  EXPECT_THROW(ledger.require_files(), IoError);
}

TEST_F(LedgerOfAFolder, NoLineOutdoesAnotherOfTheSameItem) {
  const Digest newer = hash_bytes("newer");
  const fs::path shard = folder_ / "ledger-1of2.jsonl";
  folder_.write("a", "old bytes");
  open().record("a", key_, {"a"});
  folder_.write("a", "new bytes");
  Ledger(folder_.path(), shard, {path()}).record("a", newer, {"a"});
  {
    Ledger ledger(folder_.path(), path(), {shard, path()});
    EXPECT_FALSE(ledger.find_verified("a", key_)) << "its bytes are gone";
    EXPECT_TRUE(ledger.find_verified("a", newer)) << "the shard's";
    EXPECT_TRUE(ledger.find_verified("a", newer)) << "again";
  }
  folder_.write("a", "old bytes");
  EXPECT_TRUE(Ledger(folder_.path(), shard, {path()}).find_verified("a", key_))
      << "the whole run's";
}

TEST(LedgerLine, DeepValuesAreLeftOut) {
  LedgerEntry entry = some_entry();
  entry.note.clear();
  std::string body = format_ledger_line(entry);
  body.resize(body.find(",\"sum\":"));
  constexpr std::size_t kDepth = 1'000'000;
  body += concat(",\"note\":", std::string(kDepth, '['), std::string(kDepth, ']'));
  EXPECT_TRUE(parse_ledger_line(concat(body, ",\"sum\":\"", hash_bytes(body).hex(), "\"}")));
}

// A run whose folder was removed at that moment ended with 66, as if an input were missing.
TEST(Ledger, AFileThatIsGoneWhenItIsToBeRecordedIsAFailedRead) {
  const testing::TemporaryFolder folder;
  Ledger ledger(folder.path(), folder / "ledger.jsonl", {});
  testing::expect_error(ExitCode::kIoError, {"gone.json"},
                        [&] { ledger.record("gone.json", Digest{}, {"gone.json"}); });
}

}  // namespace
}  // namespace crowdface

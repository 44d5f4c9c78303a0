// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/ledger.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kEndItem =
    "end";  // the last line of a finished crowd: its key is all the others
constexpr std::string_view kSum = R"(,"sum":")", kEnd = R"("})";

std::optional<std::string> text_at(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

std::optional<Digest> digest_at(const Json& json, const char* key) {
  const auto text = text_at(json, key);
  return text ? parse_digest(*text) : std::nullopt;
}

std::optional<LedgerEntry::File> file_of(const Json& json) {
  if (!json.is_object()) return std::nullopt;
  const auto name = text_at(json, "file");
  const auto hash = digest_at(json, "hash");
  const auto bytes = json.find("bytes");
  if (!name || !hash || bytes == json.end() || !bytes->is_number_unsigned()) return std::nullopt;
  return LedgerEntry::File{*name, {bytes->get<std::uint64_t>(), *hash}};
}

/// How many files stand in each folder of the crowd; "." are those in none.
using FileCounts = std::map<std::string, std::size_t>;

void add_counts(const LedgerEntry& entry, FileCounts& counts) {
  for (const LedgerEntry::File& file : entry.files) {
    const std::size_t slash = file.name.find('/');
    ++counts[slash == file.name.npos ? "." : file.name.substr(0, slash)];
  }
}

/// The same as JSON.
std::string count_files(const std::vector<LedgerEntry>& entries) {
  FileCounts counts;
  for (const LedgerEntry& entry : entries) add_counts(entry, counts);
  return Json(counts).dump();
}

std::string format_all(const std::vector<LedgerEntry>& entries) {
  std::string text;
  for (const LedgerEntry& entry : entries) text += format_ledger_line(entry) + '\n';
  return text;
}

}  // namespace

std::string format_ledger_line(const LedgerEntry& entry) {
  Json json;
  json["item"] = entry.item;
  json["key"] = entry.key.hex();
  json["files"] = Json::array();
  for (const LedgerEntry::File& file : entry.files) {
    json["files"].push_back(
        {{"file", file.name}, {"bytes", file.content.bytes}, {"hash", file.content.digest.hex()}});
  }
  if (!entry.note.empty()) json["note"] = Json::parse(entry.note);
  std::string line = json.dump();
  line.pop_back();
  const std::string sum = hash_bytes(line).hex();
  return concat(line, kSum, sum, kEnd);
}

std::optional<LedgerEntry> parse_ledger_line(std::string_view line) {
  constexpr std::size_t kHex = 32;
  const std::size_t tail = kSum.size() + kHex + kEnd.size();
  if (line.size() < tail) return std::nullopt;
  const std::string_view body = line.substr(0, line.size() - tail);
  if (line.substr(body.size()) != concat(kSum, hash_bytes(body).hex(), kEnd)) return std::nullopt;
  const Json json = parse_shallow_json(line);
  if (!json.is_object()) return std::nullopt;
  const auto item = text_at(json, "item");
  const auto key = digest_at(json, "key");
  const auto files = json.find("files");
  if (!item || !key || files == json.end() || !files->is_array()) return std::nullopt;
  LedgerEntry entry{*item, *key, {}, {}};
  for (const Json& each : *files) {
    auto file = file_of(each);
    if (!file) return std::nullopt;
    entry.files.push_back(std::move(*file));
  }
  if (const auto note = json.find("note"); note != json.end()) entry.note = note->dump();
  return entry;
}

LedgerLines parse_ledger(const std::string& text) {
  LedgerLines lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    // A line without its end was being written when the run died, even if all else is there.
    std::optional<LedgerEntry> entry;
    if (end != text.npos) {
      entry = parse_ledger_line(std::string_view(text).substr(begin, end - begin));
    }
    if (entry && entry->item == kEndItem) {
      lines.complete = entry->key == hash_bytes(std::string_view(text).substr(0, begin)) &&
                       (entry->note.empty() || entry->note == count_files(lines.entries));
    } else if (entry) {
      lines.entries.push_back(std::move(*entry));
    } else {
      ++lines.damaged;
    }
    begin = end == text.npos ? text.size() : end + 1;
  }
  return lines;
}

LedgerLines read_ledger(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  return parse_ledger(read_file(path));
}

bool files_match(const fs::path& root, const LedgerEntry& entry) {
  return std::all_of(entry.files.begin(), entry.files.end(), [&](const LedgerEntry::File& file) {
    return holds(root / file.name, file.content);
  });
}

void add_lines(LedgerLines lines, LinesOfItems& to) {
  for (LedgerEntry& entry : lines.entries) to[entry.item].push_back(std::move(entry));
}

Ledger::Ledger(fs::path root, const fs::path& own, const std::vector<fs::path>& others)
    : root_(std::move(root)), own_(own) {
  for (const fs::path& other : others) {
    if (other == own) continue;
    others_.push_back(other);
    add_lines(read_ledger(other), read_);
  }
  std::error_code ignored;
  const bool exists = fs::exists(own, ignored);
  if (exists) settled_ = read_file(own);
  LedgerLines lines = parse_ledger(settled_);
  if (lines.damaged > 0) {
    log_warning(concat(own.string(), ": ", lines.damaged,
                       lines.damaged == 1 ? " line is" : " lines are",
                       " not whole; what they stand for is done again"));
  }
  if (lines.damaged > 0 || !exists) write_file(own, format_all(lines.entries));
  add_lines(std::move(lines), read_);
  file_ = std::make_unique<AppendFile>(own);
}

std::optional<LedgerEntry> Ledger::proven(const std::string& item, const Digest& key) {
  std::vector<LedgerEntry> candidates;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = done_.find(item); found != done_.end()) {
      candidates.push_back(found->second);
    } else if (const auto lines = read_.find(item); lines != read_.end()) {
      candidates.assign(lines->second.rbegin(), lines->second.rend());
    }
  }
  for (const LedgerEntry& entry : candidates) {
    if (entry.key != key || !files_match(root_, entry)) continue;
    const std::lock_guard lock(mutex_);
    done_[item] = entry;
    return entry;
  }
  return std::nullopt;
}

void Ledger::record(std::vector<LedgerEntry> entries) {
  if (entries.empty()) return;
  file_->append(format_all(entries));
  const std::lock_guard lock(mutex_);
  settled_.clear();
  for (LedgerEntry& entry : entries) {
    std::string item = entry.item;
    done_[std::move(item)] = std::move(entry);
  }
}

void Ledger::record(const std::string& item, const Digest& key,
                    const std::vector<std::string>& names) {
  record({{item, key, files_now(names), {}}});
}

std::vector<LedgerEntry::File> Ledger::files_now(const std::vector<std::string>& names) const {
  std::vector<LedgerEntry::File> files;
  for (const std::string& name : names) files.push_back({name, hash_file(root_ / name)});
  return files;
}

void Ledger::write(const std::string& name, std::string_view bytes) {
  const FileDigest content = {bytes.size(), hash_bytes(bytes)};
  if (proven(name, content.digest)) return;
  const LedgerEntry entry{name, content.digest, {{name, content}}, {}};
  if (!files_match(root_, entry)) write_file(root_ / name, bytes);
  record({entry});
}

void Ledger::adopt_entry(LedgerEntry entry, std::vector<LedgerEntry::File> files) {
  if (files == entry.files) return;
  entry.files = std::move(files);
  entry.key = Hasher().add(entry.key).add("made anew").digest();
  record({std::move(entry)});
}

void Ledger::adopt(const std::string& item, const std::vector<std::string>& names,
                   const std::vector<std::string>& folders) {
  const auto is_in_them = [&](const std::string& name) {
    return std::any_of(folders.begin(), folders.end(),
                       [&](const std::string& folder) { return name.starts_with(folder + '/'); });
  };
  const auto known = read_.find(item);
  adopt_entry(known == read_.end() ? LedgerEntry{item, {}, {}, {}} : known->second.back(),
              files_now(names));
  // Of several lines the last that the files elsewhere agree with, else the last.
  const auto line_of = [&](const std::vector<LedgerEntry>& lines) {
    if (lines.size() == 1) return lines.back();
    const auto agreed = std::find_if(lines.rbegin(), lines.rend(), [&](const LedgerEntry& line) {
      return std::all_of(line.files.begin(), line.files.end(), [&](const auto& file) {
        return is_in_them(file.name) || holds(root_ / file.name, file.content);
      });
    });
    return agreed == lines.rend() ? lines.back() : *agreed;
  };
  for (const auto& [other, lines] : read_) {
    if (other == item) continue;
    LedgerEntry entry = line_of(lines);
    std::vector<LedgerEntry::File> files = entry.files;
    for (LedgerEntry::File& file : files) {
      std::error_code ignored;
      if (!is_in_them(file.name) || !fs::exists(root_ / file.name, ignored)) continue;
      file.content = hash_file(root_ / file.name);
    }
    adopt_entry(std::move(entry), std::move(files));
  }
}

void Ledger::settle() {
  std::string text;
  FileCounts counts;
  for (const auto& [item, entry] : done_) {
    text += format_ledger_line(entry) + '\n';
    add_counts(entry, counts);
  }
  text += format_all({{kEndItem, hash_bytes(text), {}, Json(counts).dump()}});
  if (settled_ != text) write_file(own_, text);
  for (const fs::path& other : others_) {
    std::error_code error;
    if (!fs::remove(other, error) && error) {
      throw IoError(concat(other.string(), ": cannot be removed: ", error.message()));
    }
  }
}

void Ledger::require_files() const {
  const auto require = [&](const fs::path& path) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return;
    throw IoError(concat(path.string(),
                         ": was removed while the run was at work; run the same command again"));
  };
  require(own_);
  for (const auto& [item, entry] : done_) {
    for (const LedgerEntry::File& file : entry.files) require(root_ / file.name);
  }
}

}  // namespace crowdface

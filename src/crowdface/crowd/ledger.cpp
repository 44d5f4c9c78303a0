// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/ledger.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Item name of the last line in the ledger of a finished crowd. The key in this line is the hash
/// of all other lines.
constexpr const char* kEndItem = "end";
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

/// Number of files in each top-level subfolder of the crowd's folder. The key "." counts the files
/// that are in no subfolder.
using FileCounts = std::map<std::string, std::size_t>;

void add_counts(const LedgerEntry& entry, FileCounts& counts) {
  for (const LedgerEntry::File& file : entry.files) {
    const std::size_t slash = file.name.find('/');
    ++counts[slash == file.name.npos ? "." : file.name.substr(0, slash)];
  }
}

/// Returns the FileCounts of all entries as JSON text.
std::string file_counts_json(const std::vector<LedgerEntry>& entries) {
  FileCounts counts;
  for (const LedgerEntry& entry : entries) add_counts(entry, counts);
  return Json(counts).dump();
}

std::string line_with_end(const LedgerEntry& entry) {
  return format_ledger_line(entry) + '\n';
}

/// Reads a ledger line by line.
class LedgerReader {
 public:
  void read(std::string_view line, bool ended) {
    // Do not trust a line without a line end, even if the line looks complete: the run died while
    // it wrote this line.
    std::optional<LedgerEntry> entry;
    if (ended) entry = parse_ledger_line(line);
    if (entry && entry->item == kEndItem) {
      lines.is_complete = entry->key == line_hash_.digest() &&
                          (entry->note.empty() || entry->note == file_counts_json(lines.entries));
    } else if (entry) {
      lines.entries.push_back(std::move(*entry));
    } else {
      ++lines.damaged_count;
    }
    line_hash_.add_raw(line).add_raw("\n");
  }

  LedgerLines lines;

 private:
  Hasher line_hash_;  ///< hash of the lines read so far
};

}  // namespace

Json file_to_json(const LedgerEntry::File& file) {
  return {{"file", file.name}, {"bytes", file.content.bytes}, {"hash", file.content.digest.hex()}};
}

std::optional<std::vector<LedgerEntry::File>> files_from_json(const Json& list) {
  if (!list.is_array()) return std::nullopt;
  std::vector<LedgerEntry::File> files;
  for (const Json& file : list) {
    if (!file.is_object()) return std::nullopt;
    const auto name = text_at(file, "file");
    const auto hash = digest_at(file, "hash");
    const Json bytes = file.value("bytes", Json());
    if (!name || !hash || !bytes.is_number_unsigned()) return std::nullopt;
    files.push_back({*name, {bytes.get<std::uint64_t>(), *hash}});
  }
  return files;
}

std::string format_ledger_line(const LedgerEntry& entry) {
  Json json;
  json["item"] = entry.item;
  json["key"] = entry.key.hex();
  json["files"] = Json::array();
  for (const LedgerEntry::File& file : entry.files) json["files"].push_back(file_to_json(file));
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
  const auto list = json.find("files");
  auto files = list == json.end() ? std::nullopt : files_from_json(*list);
  if (!item || !key || !files) return std::nullopt;
  LedgerEntry entry{*item, *key, std::move(*files), {}};
  if (const auto note = json.find("note"); note != json.end()) entry.note = note->dump();
  return entry;
}

LedgerLines parse_ledger(std::string_view text) {
  LedgerReader reader;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    reader.read(text.substr(0, end), end != text.npos);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  return std::move(reader.lines);
}

LedgerLines read_ledger(const fs::path& path, std::string_view item) {
  if (!path_exists(path)) return {};
  std::string start = item.empty() ? "" : concat(R"({"item":)", Json(item).dump());
  if (!start.empty()) start.pop_back();  // drop the quote after the name
  LedgerReader reader;
  read_lines(path, [&](std::string_view line, bool ended) {
    if (line.starts_with(start)) reader.read(line, ended);
  });
  return std::move(reader.lines);
}

void remove_recorded_file(const fs::path& root, const LedgerEntry::File& file) {
  fs::path path = root / file.name;
  if (!is_inside_folder(path, root) || !has_content(path, file.content)) return;
  std::error_code error;
  fs::remove(path, error);
  if (error) throw IoError(concat(path.string(), ": cannot be removed: ", error.message()));
  do {
    path = path.parent_path();
  } while (path != root && fs::remove(path, error));  // removes only empty folders
}

bool files_match(const fs::path& root, const LedgerEntry& entry) {
  return std::all_of(entry.files.begin(), entry.files.end(), [&](const LedgerEntry::File& file) {
    return has_content(root / file.name, file.content);
  });
}

Ledger::Ledger(fs::path root, const fs::path& own_ledger, const std::vector<fs::path>& others)
    : root_(std::move(root)), own_ledger_(own_ledger) {
  const auto add = [&](LedgerLines lines) {
    for (LedgerEntry& entry : lines.entries) {
      items_[entry.item].lines.push_back(std::move(entry));
    }
  };
  for (const fs::path& other : others) {
    if (other == own_ledger) continue;
    other_ledgers_.push_back(other);
    add(read_ledger(other));
  }
  LedgerLines lines = read_ledger(own_ledger);
  if (lines.damaged_count > 0) {
    log_warning(concat(own_ledger.string(), ": ", lines.damaged_count,
                       lines.damaged_count == 1 ? " line is" : " lines are",
                       " damaged; the work that was recorded there is done again"));
  }
  if (lines.damaged_count > 0 || !path_exists(own_ledger)) {
    write_file(own_ledger, text_of_items(lines.entries.size(), [&](std::size_t i) {
                 return line_with_end(lines.entries[i]);
               }));
  }
  add(std::move(lines));
  file_ = std::make_unique<AppendFile>(own_ledger);
}

std::optional<LedgerEntry> Ledger::find_verified(const std::string& item, const Digest& key) {
  std::vector<LedgerEntry> candidates;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = items_.find(item); found != items_.end()) {
      const std::vector<LedgerEntry>& lines = found->second.lines;
      candidates.assign(lines.rbegin(), lines.rend());
    }
  }
  for (const LedgerEntry& entry : candidates) {
    if (entry.key != key || !files_match(root_, entry)) continue;
    const std::lock_guard lock(mutex_);
    set_finished_entry(entry);
    return entry;
  }
  return std::nullopt;
}

void Ledger::set_finished_entry(LedgerEntry entry) {
  Item& item = items_[entry.item];
  for (const LedgerEntry& line : item.lines) {
    for (const LedgerEntry::File& file : line.files) {
      const auto& files = entry.files;
      const bool stays =
          std::ranges::find(files, file.name, &LedgerEntry::File::name) != files.end();
      if (!stays) replaced_files_.push_back(file);
    }
  }
  item.lines.clear();
  item.lines.push_back(std::move(entry));
  item.is_finished = true;
}

void Ledger::record_all(std::vector<LedgerEntry> entries) {
  if (entries.empty()) return;
  std::string lines;
  for (const LedgerEntry& entry : entries) lines += line_with_end(entry);
  file_->append(lines);
  const std::lock_guard lock(mutex_);
  has_appended_ = true;
  for (LedgerEntry& entry : entries) set_finished_entry(std::move(entry));
}

void Ledger::record(LedgerEntry entry) {
  record_all({std::move(entry)});
}

void Ledger::record(const std::string& item, const Digest& key,
                    const std::vector<std::string>& names) {
  record({item, key, hash_files(names), {}});
}

std::vector<LedgerEntry::File> Ledger::hash_files(const std::vector<std::string>& names) const {
  std::vector<LedgerEntry::File> files;
  try {
    for (const std::string& name : names) files.push_back({name, hash_file(root_ / name)});
    // The file is not an input: this run has just written it. Therefore report a missing file as
    // IoError.
  } catch (const MissingInput& error) {
    throw IoError(error.what());
  }
  return files;
}

FileDigest Ledger::write(const std::string& name, const TextPieces& text) {
  if (!path_exists(root_ / name)) {
    const FileDigest content = write_file(root_ / name, text);
    record_existing({name, content});
    return content;
  }
  const LedgerEntry::File file{name, digest_of(text)};
  if (find_verified(name, file.content.digest)) return file.content;
  if (!has_content(root_ / name, file.content)) write_file(root_ / name, text);
  record_existing(file);
  return file.content;
}

FileDigest Ledger::write(const std::string& name, std::string_view bytes) {
  return write(name, [&](const TextSink& take) { take(bytes); });
}

void Ledger::record_existing(const LedgerEntry::File& file) {
  record({file.name, file.content.digest, {file}, {}});
}

void Ledger::record_remade_entry(LedgerEntry entry, std::vector<LedgerEntry::File> files) {
  if (files == entry.files) return;
  entry.files = std::move(files);
  entry.key = Hasher().add(entry.key).add("made anew").digest();
  record(std::move(entry));
}

void Ledger::record_remade_files(const std::string& item,
                                 const std::vector<std::string>& file_names,
                                 const std::vector<std::string>& remade_folders) {
  const auto is_in_them = [&](const std::string& name) {
    return std::any_of(remade_folders.begin(), remade_folders.end(),
                       [&](const std::string& folder) { return name.starts_with(folder + '/'); });
  };
  const auto known = items_.find(item);
  record_remade_entry(
      known == items_.end() ? LedgerEntry{item, {}, {}, {}} : known->second.lines.back(),
      hash_files(file_names));
  // If an item has several lines, take the last line that matches the existing files. If no line
  // matches, take the last line.
  const auto line_of = [&](const std::vector<LedgerEntry>& lines) {
    if (lines.size() == 1) return lines.back();
    const auto agreed = std::find_if(lines.rbegin(), lines.rend(), [&](const LedgerEntry& line) {
      return std::all_of(line.files.begin(), line.files.end(), [&](const auto& file) {
        return is_in_them(file.name) || has_content(root_ / file.name, file.content);
      });
    });
    return agreed == lines.rend() ? lines.back() : *agreed;
  };
  for (const auto& [other, known_of] : items_) {
    if (other == item) continue;
    LedgerEntry entry = line_of(known_of.lines);
    std::vector<LedgerEntry::File> files = entry.files;
    for (LedgerEntry::File& file : files) {
      if (!is_in_them(file.name) || !path_exists(root_ / file.name)) continue;
      file.content = hash_file(root_ / file.name);
    }
    record_remade_entry(std::move(entry), std::move(files));
  }
}

void Ledger::write_text(const TextSink& take) const {
  Hasher before;
  FileCounts counts;
  std::vector<const LedgerEntry*> done;
  for (const auto& [name, item] : items_) {
    if (!item.is_finished) continue;
    done.push_back(&item.lines.front());
    add_counts(*done.back(), counts);
  }
  text_of_items(done.size(),
                [&](std::size_t i) { return line_with_end(*done[i]); })([&](std::string_view line) {
    before.add_raw(line);
    take(line);
  });
  take(line_with_end({kEndItem, before.digest(), {}, Json(counts).dump()}));
}

void Ledger::remove_outdated_files() const {
  std::vector<LedgerEntry::File> outdated = replaced_files_;
  for (const auto& [name, item] : items_) {
    if (item.is_finished) continue;
    for (const LedgerEntry& line : item.lines) {
      outdated.insert(outdated.end(), line.files.begin(), line.files.end());
    }
  }
  if (outdated.empty()) return;
  std::set<std::string_view> kept;
  for (const auto& [name, item] : items_) {
    if (!item.is_finished) continue;
    for (const LedgerEntry::File& file : item.lines.front().files) kept.insert(file.name);
  }
  for (const LedgerEntry::File& file : outdated) {
    if (!kept.contains(file.name)) remove_recorded_file(root_, file);
  }
}

void Ledger::compact() {
  remove_outdated_files();
  const TextPieces text = [&](const TextSink& take) { write_text(take); };
  if (has_appended_ || !has_content(own_ledger_, digest_of(text))) write_file(own_ledger_, text);
  for (const fs::path& other : other_ledgers_) {
    std::error_code error;
    if (!fs::remove(other, error) && error) {
      throw IoError(concat(other.string(), ": cannot be removed: ", error.message()));
    }
  }
}

void Ledger::require_files() const {
  const auto require = [&](const fs::path& path) {
    if (path_exists(path)) return;
    throw IoError(
        concat(path.string(), ": was removed during the run; run the same command again"));
  };
  require(own_ledger_);
  for (const auto& [name, item] : items_) {
    if (!item.is_finished) continue;
    for (const LedgerEntry::File& file : item.lines.front().files) require(root_ / file.name);
  }
}

}  // namespace crowdface

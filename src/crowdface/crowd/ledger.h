// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crowdface/core/append_file.h"
#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/core/text_pieces.h"

namespace crowdface {

/// One thing that is done: all its files were written, and on the disk, before its line was.
struct LedgerEntry {
  struct File {
    std::string name;  ///< relative to the crowd's folder, '/' between its parts
    FileDigest content;
    bool operator==(const File&) const = default;
  };
  std::string item;         ///< "faces/market_0001", "report.json"
  Digest key;               ///< of everything that determines the files
  std::vector<File> files;  ///< may be empty
  std::string note;         ///< JSON that a later run needs, or empty
};

/// {"file": …, "bytes": …, "hash": …}
nlohmann::ordered_json file_to_json(const LedgerEntry::File& file);
/// \return nothing if it is no such list.
std::optional<std::vector<LedgerEntry::File>> files_from_json(const nlohmann::ordered_json& list);

/// One line, without line end, and its checksum (docs/crowd-directory.md).
std::string format_ledger_line(const LedgerEntry& entry);
/// \return nothing if the line is cut, altered or no such line.
std::optional<LedgerEntry> parse_ledger_line(std::string_view line);

/// A ledger's whole lines, in their order.
struct LedgerLines {
  std::vector<LedgerEntry> entries;
  std::size_t damaged = 0;  ///< lines that are not whole
  /// A run came to its end, and all lines that it left are there, with as many files of each kind as
  /// it counted.
  bool complete = false;
};
LedgerLines parse_ledger(std::string_view text);
/// \param item  what the items begin with whose lines are read; empty: all.
/// \return no lines if there is no such file. \throws IoError.
LedgerLines read_ledger(const std::filesystem::path& path, std::string_view item = {});

/// Whether all files of an entry stand in the folder as they were written.
bool files_match(const std::filesystem::path& root, const LedgerEntry& entry);

/// Removes a file of a crowd that still has the bytes that were recorded, and folders that are empty then. Others, and
/// what lies outside the crowd's folder, stay. \throws IoError.
void remove_recorded(const std::filesystem::path& root, const LedgerEntry::File& file);

/// What is done in a crowd's folder, so that another run can go on. Lines are appended while the
/// run lasts; in the end the ledger is put in order, and then the same crowd has the same ledger.
/// Any thread may ask and record.
class Ledger {
 public:
  /// Reads all ledgers of the folder. Lines that are not whole are dropped with a warning: what they
  /// stood for counts as not done.
  /// \param own     the ledger to append to, made if it is not there.
  /// \param others  those of other runs, only read. No line outdoes another: which of them is newer
  ///                cannot be told, and any may prove what it stands for.
  Ledger(std::filesystem::path root, const std::filesystem::path& own,
         const std::vector<std::filesystem::path>& others);

  /// An entry of the item that has this key and whose files match: nothing needs to be done.
  std::optional<LedgerEntry> proven(const std::string& item, const Digest& key);

  /// Appends a line for each. Their files must have been written by `write_file` or `write_files`. \throws IoError.
  void record_all(std::vector<LedgerEntry> entries);
  void record(LedgerEntry entry);
  /// The same for files whose hashes are not known yet. \param names  relative to the folder.
  void record(const std::string& item, const Digest& key, const std::vector<std::string>& names);

  /// Writes a file determined by nothing but its bytes, unless it is there, and records it.
  FileDigest write(const std::string& name, const TextPieces& text);
  FileDigest write(const std::string& name, std::string_view bytes);
  /// Records a file determined by nothing but its bytes that is there as it should be.
  void keep(const LedgerEntry::File& file);

  /// Takes over files that were made anew, maybe in another form than the config's. What has other
  /// bytes now is recorded under another key, so that the next run makes it as the config says;
  /// what is as it was keeps its line.
  /// \param item, names  an item and the files that it has now
  /// \param folders      files of other items are looked at if they lie in one of these
  void adopt(const std::string& item, const std::vector<std::string>& names,
             const std::vector<std::string>& folders);

  /// Puts the ledger in order: what this run found proven or recorded, sorted by item, and nothing
  /// else; the other ledgers are removed, and the files that only older lines name.
  void settle();

  /// To be asked before a run says that it is done. \throws IoError if a file that this run found
  /// proven or recorded, or the ledger itself, is not there any more.
  void require_files() const;

 private:
  /// An item's lines as they were when this run began, or the one that it found proven or recorded.
  struct Item {
    std::vector<LedgerEntry> lines;
    bool done = false;
  };

  void settle_on(LedgerEntry entry);
  void remove_outdated_files() const;
  std::vector<LedgerEntry::File> files_now(const std::vector<std::string>& names) const;
  void adopt_entry(LedgerEntry entry, std::vector<LedgerEntry::File> files);
  void give_text(const TakePiece& take) const;

  std::filesystem::path root_, own_;
  std::vector<std::filesystem::path> others_;
  std::map<std::string, Item> items_;
  std::vector<LedgerEntry::File> replaced_;  ///< of lines that others took the place of
  bool grown_ = false;                       ///< whether lines were appended
  std::mutex mutex_;
  std::unique_ptr<AppendFile> file_;
};

}  // namespace crowdface

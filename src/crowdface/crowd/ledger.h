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

/// One finished item, such as a face, and its files. All files are written and synced to disk
/// before the ledger gets the item's line.
struct LedgerEntry {
  struct File {
    std::string name;    ///< path relative to the crowd's folder, with '/' separators
    FileDigest content;  ///< size and hash of the file's content
    bool operator==(const File&) const = default;
  };
  std::string item;         ///< name of the item, such as "faces/market_0001"
  Digest key;               ///< hash of everything that determines the files
  std::vector<File> files;  ///< files that belong to the item; may be empty
  std::string note;  ///< further results as JSON, such as the defects of a face's skin; or empty
};

/// Formats a file as {"file": …, "bytes": …, "hash": …}.
nlohmann::ordered_json file_to_json(const LedgerEntry::File& file);
/// Parses a JSON list of files that file_to_json formatted.
/// \return the files in `list`; nothing if `list` is not a valid list of files.
std::optional<std::vector<LedgerEntry::File>> files_from_json(const nlohmann::ordered_json& list);

/// Formats an entry as one line with a checksum and without a line end (docs/crowd-directory.md).
std::string format_ledger_line(const LedgerEntry& entry);
/// Parses a line that format_ledger_line formatted.
/// \return the entry; nothing if the line is truncated, altered or not a ledger line.
std::optional<LedgerEntry> parse_ledger_line(std::string_view line);

/// The valid lines of a ledger, in their order.
struct LedgerLines {
  std::vector<LedgerEntry> entries;
  std::size_t damaged_count = 0;  ///< number of invalid lines
  /// Whether a finished run wrote the ledger and no line is missing: the hash and the file counts
  /// in the last line match the other lines.
  bool is_complete = false;
};
/// Parses the text of a ledger file.
LedgerLines parse_ledger(std::string_view text);
/// Reads the lines of a ledger file.
/// \param item  reads only lines of items whose names start with this text; empty: all lines.
/// \return no lines if the file does not exist.
/// \throws IoError.
LedgerLines read_ledger(const std::filesystem::path& path, std::string_view item = {});

/// Whether all files that an entry lists exist in the folder and have the recorded content.
bool files_match(const std::filesystem::path& root, const LedgerEntry& entry);

/// Removes a file of a crowd if the file still has the recorded content. Then removes the file's
/// parent folders that became empty. Keeps altered files and files outside the crowd's folder.
/// \throws IoError.
void remove_recorded_file(const std::filesystem::path& root, const LedgerEntry::File& file);

/// Records finished work in a crowd's folder, so that another run can continue. A run appends lines
/// to the ledger and, at the end, sorts the lines, so that equal crowds have equal ledgers. All
/// threads may find and record entries.
class Ledger {
 public:
  /// Reads all ledgers of the folder. Drops damaged lines with a warning, so that their items count
  /// as unfinished.
  /// \param own_ledger  the ledger to append to; created if it does not exist.
  /// \param others      ledgers of other runs, which are only read. If several ledgers list an
  ///                item, any of these lines may prove that the item is finished. No line takes
  ///                precedence, because the order in which the lines were written is unknown.
  Ledger(std::filesystem::path root, const std::filesystem::path& own_ledger,
         const std::vector<std::filesystem::path>& others);

  /// Returns a ledger line with this item and this key whose files are unchanged. Such a line
  /// proves that the item is finished.
  std::optional<LedgerEntry> find_verified(const std::string& item, const Digest& key);

  /// Appends one line for each entry to the ledger. The files of the entries must have been written
  /// by `write_file` or `write_files`.
  /// \throws IoError.
  void record_all(std::vector<LedgerEntry> entries);
  /// Like record_all, for one entry.
  void record(LedgerEntry entry);
  /// Computes the hashes of the files, then records them.
  /// \param names  paths relative to the folder.
  void record(const std::string& item, const Digest& key, const std::vector<std::string>& names);

  /// Writes a file and records it; the ledger key is the hash of the content. Does not write if the
  /// file already has this content.
  /// \param name  path relative to the folder.
  FileDigest write(const std::string& name, const TextPieces& text);
  FileDigest write(const std::string& name, std::string_view bytes);
  /// Records a file that already exists with the right content. The ledger key is the hash of the
  /// content.
  void record_existing(const LedgerEntry::File& file);

  /// Updates the ledger after files were remade, possibly with other settings than the config's.
  /// Each item with a changed file gets a key that no run looks for, so that the next run makes
  /// this item again with the config's settings. Items with unchanged files keep their lines.
  /// \param item, file_names  an item, and the names of all files that the item now has
  /// \param remade_folders    folders with remade files; the function also hashes the files of all
  ///                          other items in these folders
  void record_remade_files(const std::string& item, const std::vector<std::string>& file_names,
                           const std::vector<std::string>& remade_folders);

  /// Sorts the ledger by item and keeps only the entries that this run verified or recorded.
  /// Removes all other ledgers, and the files that are named only in outdated lines.
  void compact();

  /// Call this before a run reports success.
  /// \throws IoError if the ledger or a file that this run verified or recorded no longer exists.
  void require_files() const;

 private:
  /// The ledger lines of one item. At first, these are the lines that earlier runs wrote. Once this
  /// run has recorded the item or verified its files, `is_finished` is true and `lines` has only
  /// one entry: the recorded or verified entry.
  struct Item {
    std::vector<LedgerEntry> lines;
    bool is_finished = false;
  };

  /// Marks the entry's item as finished: replaces all lines of the item by this entry.
  void set_finished_entry(LedgerEntry entry);
  /// Removes the files that only outdated lines list.
  void remove_outdated_files() const;
  /// Computes size and hash of files. \throws IoError if a file does not exist.
  std::vector<LedgerEntry::File> hash_files(const std::vector<std::string>& names) const;
  /// If `files` differ from the entry's files, records the entry with `files` and a new key.
  void record_remade_entry(LedgerEntry entry, std::vector<LedgerEntry::File> files);
  /// Passes the lines of the compacted ledger to `take`.
  void write_text(const TextSink& take) const;

  std::filesystem::path root_, own_ledger_;  ///< the crowd's folder; this run's ledger
  /// the ledgers of other runs, which this object only reads
  std::vector<std::filesystem::path> other_ledgers_;
  std::map<std::string, Item> items_;  ///< all items; the key is the name of the item
  /// Old files of items that were made again. When an item is finished, its new ledger line may
  /// lack files that an older line of the same item lists; these files are stored here. `compact`
  /// removes such a file, unless the new line of another item lists the file.
  std::vector<LedgerEntry::File> replaced_files_;
  bool has_appended_ = false;         ///< whether this run has appended lines
  std::mutex mutex_;                  ///< guards items_, replaced_files_ and has_appended_
  std::unique_ptr<AppendFile> file_;  ///< the open file at own_ledger_
};

}  // namespace crowdface

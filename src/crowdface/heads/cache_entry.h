// SPDX-License-Identifier: Apache-2.0
// The one format of the cache's files: a header, the key, named arrays, a checksum (docs/cache-format.md).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/hash.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The ending of the cache's files.
inline constexpr std::string_view kCacheEnding = ".cfcache";

/// Names an entry. The file is called `kind-digest.cfcache`; its header holds a hash of both, so that an entry under
/// another entry's name is noticed.
struct CacheKey {
  std::string_view kind;  ///< for example "mesh"; a part of the file's name
  Digest digest;          ///< of everything that the arrays depend on
};

std::filesystem::path cache_entry(const std::filesystem::path& cache, const CacheKey& key);

namespace detail {

/// The numbers that an array's elements consist of.
template <class T>
struct Element {
  using Number = T;
  static constexpr std::uint32_t kNumbers = 1;
};
template <class T, std::size_t N>
struct Element<std::array<T, N>> {
  using Number = T;
  static constexpr std::uint32_t kNumbers = N;
};
template <>
struct Element<Digest> {
  using Number = std::uint64_t;
  static constexpr std::uint32_t kNumbers = 2;
};

/// The type of an array's numbers as the file tells it: "f4", "u8", "i2".
template <class T>
constexpr std::array<char, 4> number_type() {
  static_assert(std::is_arithmetic_v<T>);
  return {std::is_floating_point_v<T> ? 'f'
          : std::is_unsigned_v<T>     ? 'u'
                                      : 'i',
          static_cast<char>('0' + sizeof(T)), 0, 0};
}

}  // namespace detail

/// An array of an entry: where its numbers lie in memory.
struct EntryArray {
  std::string name;  ///< at most 23 bytes
  std::array<char, 4> type;
  std::uint32_t
      columns;  ///< numbers that stand together: of an element, or of a row of a row-major matrix
  std::uint64_t rows;
  const void* data;
  std::uint64_t bytes;
  std::shared_ptr<const void>
      owner;  ///< of the numbers, if nobody else owns them while the entry is written
};

/// Collects arrays that are to be written: `arrays("name", value)` for a number, a std::array of numbers, a vector or
/// span of such, or a matrix. The values must live until the entry is written.
class ArrayWriter {
 public:
  template <class T>
  void operator()(std::string_view name, const T& value) {
    add(name, std::span<const T>(&value, 1));
  }
  template <class T>
  void operator()(std::string_view name, const std::vector<T>& values) {
    add(name, std::span<const T>(values));
  }
  void operator()(std::string_view name, const std::vector<bool>& values) {
    const auto owner =
        std::make_shared<const std::vector<std::uint8_t>>(values.begin(), values.end());
    operator()(name, *owner);
    arrays.back().owner = owner;
  }
  template <class T>
  void operator()(std::string_view name, const std::span<const T>& values) {
    add(name, values);
  }
  template <class Scalar, int R, int C, int O>
  void operator()(std::string_view name, const Eigen::Matrix<Scalar, R, C, O>& matrix) {
    add<Scalar>(name, matrix.innerSize(), matrix.outerSize(), matrix.data());
  }

  std::vector<EntryArray> arrays;

 private:
  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    using Element = detail::Element<T>;
    add<typename Element::Number>(name, Element::kNumbers, values.size(), values.data());
  }
  template <class Number>
  void add(std::string_view name, auto columns, auto rows, const void* data) {
    arrays.push_back({std::string(name), detail::number_type<Number>(),
                      static_cast<std::uint32_t>(columns), static_cast<std::uint64_t>(rows), data,
                      static_cast<std::uint64_t>(columns * rows) * sizeof(Number), nullptr});
  }
};

/// Writes an entry. \throws CannotCreate, IoError.
void write_entry(const std::filesystem::path& cache, const CacheKey& key,
                 const std::vector<EntryArray>& arrays);

/// Whether all numbers are finite, and none larger than coordinates of a mesh may be, with room for
/// what smoothing makes of them.
bool are_coordinates(std::span<const float> values);
bool are_coordinates(std::span<const double> values);
/// Whether all numbers are below `end`; in `are_rows` some may be kNoIndex, too.
bool all_below(std::span<const std::uint32_t> numbers, std::uint64_t end);
bool are_rows(std::span<const std::uint32_t> numbers, std::uint64_t end);

/// An entry, mapped: its arrays lie in the file, for as long as `file()` lives.
class CacheEntry {
 public:
  /// \param known  the checksum, if the file's bytes are known to have it; otherwise they are hashed.
  /// \return nothing if there is no such file. \throws InvalidInput if it is damaged, of another version or of another
  ///         key.
  static std::optional<CacheEntry> open(const std::filesystem::path& cache, const CacheKey& key,
                                        const std::optional<Digest>& known = {});

  const std::shared_ptr<const MappedFile>& file() const { return file_; }
  const Digest& checksum() const { return checksum_; }

  /// An array in the file. \throws InvalidInput if the entry has no array of this name and type, or if floating-point
  /// numbers of it are no coordinates.
  template <class T>
  std::span<const T> get(std::string_view name) const {
    using Element = detail::Element<T>;
    const Row& row = find<typename Element::Number>(name);
    require_same(row.columns == Element::kNumbers);
    return {reinterpret_cast<const T*>(at(row)), row.rows};
  }
  template <class Matrix>
  Eigen::Map<const Matrix> matrix(std::string_view name) const {
    using Number = typename Matrix::Scalar;
    const Row& row = find<Number>(name);
    auto rows = static_cast<Index>(row.rows), columns = static_cast<Index>(row.columns);
    if (!Matrix::IsRowMajor) std::swap(rows, columns);
    constexpr Index kRows = Matrix::RowsAtCompileTime, kColumns = Matrix::ColsAtCompileTime;
    require_same((kRows == Eigen::Dynamic || kRows == rows) &&
                 (kColumns == Eigen::Dynamic || kColumns == columns));
    return {reinterpret_cast<const Number*>(at(row)), rows, columns};
  }

  /// A checksum shows that an entry is as somebody wrote it. What it holds may still be anything: so readers check all
  /// numbers that they use as indices and sizes. \throws InvalidInput unless it holds.
  void require(bool holds) const;
  /// \throws InvalidInput if somebody cut the file since it was opened: then some of its numbers read as zeros.
  void require_whole() const;

 private:
  /// An array as the file describes it.
  struct Row {
    char name[24];
    std::array<char, 4> type;
    std::uint32_t columns;
    std::uint64_t rows, offset;
  };
  friend void write_entry(const std::filesystem::path&, const CacheKey&,
                          const std::vector<EntryArray>&);

  template <class Number>
  const Row& find(std::string_view name) const {
    const Row& row = find(name, detail::number_type<Number>());
    if constexpr (std::is_floating_point_v<Number>) {
      require(are_coordinates({reinterpret_cast<const Number*>(at(row)), row.rows * row.columns}));
    }
    return row;
  }
  const Row& find(std::string_view name, const std::array<char, 4>& type) const;
  const char* at(const Row& row) const { return file_->bytes().data() + row.offset; }
  void require_same(bool same) const;
  void require_size(bool fits) const;

  std::filesystem::path path_;
  std::shared_ptr<const MappedFile> file_;
  Digest checksum_;
  std::vector<Row> arrays_;
};

/// Fills in values from an entry: `arrays("name", value)` as of an ArrayWriter. A span then lies in the file.
/// \throws InvalidInput as CacheEntry::get.
class ArrayReader {
 public:
  explicit ArrayReader(const CacheEntry& entry) : entry_(entry) {}

  template <class T>
  void operator()(std::string_view name, T& value) const {
    const std::span<const T> values = entry_.get<T>(name);
    entry_.require(values.size() == 1);
    value = values.front();
  }
  template <class T>
  void operator()(std::string_view name, std::vector<T>& values) const {
    const std::span<const T> found = entry_.get<T>(name);
    values.assign(found.begin(), found.end());
  }
  void operator()(std::string_view name, std::vector<bool>& values) const {
    const auto found = entry_.get<std::uint8_t>(name);
    values.assign(found.begin(), found.end());
  }
  template <class T>
  void operator()(std::string_view name, std::span<const T>& values) const {
    values = entry_.get<T>(name);
  }
  template <class Scalar, int R, int C, int O>
  void operator()(std::string_view name, Eigen::Matrix<Scalar, R, C, O>& matrix) const {
    matrix = entry_.matrix<Eigen::Matrix<Scalar, R, C, O>>(name);
  }

 private:
  const CacheEntry& entry_;
};

}  // namespace crowdface

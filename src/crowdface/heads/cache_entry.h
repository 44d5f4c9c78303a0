// SPDX-License-Identifier: Apache-2.0
// The format of all cache files: a header, the key, named arrays and a checksum
// (docs/architecture.md, "The cache").
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

/// File name extension of cache entries.
inline constexpr std::string_view kCacheExtension = ".cfcache";

/// Identifies a cache entry. The file is called `kind-digest.cfcache`; its header holds a hash of
/// both parts, so that a renamed entry is detected.
struct CacheKey {
  std::string_view kind;  ///< kind of the entry, for example "mesh"; part of the file name
  Digest digest;          ///< hash of everything that the entry's arrays depend on
};

/// Path of the file of a cache entry.
std::filesystem::path cache_entry(const std::filesystem::path& cache, const CacheKey& key);

namespace detail {

/// The number type of an array element, and how many numbers an element has.
template <class T>
struct Element {
  using Number = T;
  static constexpr std::uint32_t kNumbersPerElement = 1;
};
template <class T, std::size_t N>
struct Element<std::array<T, N>> {
  using Number = T;
  static constexpr std::uint32_t kNumbersPerElement = N;
};
template <>
struct Element<Digest> {
  using Number = std::uint64_t;
  static constexpr std::uint32_t kNumbersPerElement = 2;
};

/// The name of a number type in the file: "f4", "u8" or "i2", for example.
template <class T>
constexpr std::array<char, 4> number_type() {
  static_assert(std::is_arithmetic_v<T>);
  return {std::is_floating_point_v<T> ? 'f'
          : std::is_unsigned_v<T>     ? 'u'
                                      : 'i',
          static_cast<char>('0' + sizeof(T)), 0, 0};
}

}  // namespace detail

/// An array to write into a cache entry; points to the numbers in memory.
struct EntryArray {
  std::string name;          ///< name of the array, at most 23 bytes
  std::array<char, 4> type;  ///< name of the number type, see detail::number_type
  /// Number of contiguous numbers in one element, or in one row of a row-major matrix.
  std::uint32_t columns;
  std::uint64_t rows;   ///< number of elements, or of rows of a row-major matrix
  const void* data;     ///< pointer to the array's first number
  std::uint64_t bytes;  ///< size of the array in bytes
  /// Keeps the numbers alive until the entry is written; null if the caller keeps the numbers
  /// alive.
  std::shared_ptr<const void> owner;
};

/// Collects arrays to write. `arrays("name", value)` accepts a number, a std::array of numbers, a
/// vector or span of numbers or of such arrays, or a matrix. The values must live until the entry
/// is written.
class ArrayWriter {
 public:
  /// Adds an array with a single element.
  template <class T>
  void operator()(std::string_view name, const T& value) {
    add(name, std::span<const T>(&value, 1));
  }
  /// Adds an array with the elements of a vector.
  template <class T>
  void operator()(std::string_view name, const std::vector<T>& values) {
    add(name, std::span<const T>(values));
  }
  /// Adds an array of bytes: 1 for true, 0 for false.
  void operator()(std::string_view name, const std::vector<bool>& values) {
    const auto owner =
        std::make_shared<const std::vector<std::uint8_t>>(values.begin(), values.end());
    operator()(name, *owner);
    arrays.back().owner = owner;
  }
  /// Adds an array with the elements of a span.
  template <class T>
  void operator()(std::string_view name, const std::span<const T>& values) {
    add(name, values);
  }
  /// Adds an array with the numbers of a matrix.
  template <class Scalar, int R, int C, int O>
  void operator()(std::string_view name, const Eigen::Matrix<Scalar, R, C, O>& matrix) {
    add<Scalar>(name, matrix.innerSize(), matrix.outerSize(), matrix.data());
  }

  std::vector<EntryArray> arrays;  ///< the arrays that were added so far

 private:
  /// Appends an array to `arrays`.
  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    using Element = detail::Element<T>;
    add<typename Element::Number>(name, Element::kNumbersPerElement, values.size(), values.data());
  }
  /// Appends an array to `arrays`. \param columns, rows, data  see EntryArray
  template <class Number>
  void add(std::string_view name, auto columns, auto rows, const void* data) {
    arrays.push_back({std::string(name), detail::number_type<Number>(),
                      static_cast<std::uint32_t>(columns), static_cast<std::uint64_t>(rows), data,
                      static_cast<std::uint64_t>(columns * rows) * sizeof(Number), nullptr});
  }
};

/// Writes a cache entry. \throws CannotCreate, IoError.
void write_entry(const std::filesystem::path& cache, const CacheKey& key,
                 const std::vector<EntryArray>& arrays);

/// Whether all numbers are finite and at most as large as mesh coordinates may be, plus a margin
/// for the displacements that smoothing adds.
bool are_in_coordinate_range(std::span<const float> values);
bool are_in_coordinate_range(std::span<const double> values);
/// Whether all numbers are below `end`.
bool all_below(std::span<const std::uint32_t> numbers, std::uint64_t end);
/// Whether each number is below `end` or is kNoIndex.
bool are_indices(std::span<const std::uint32_t> numbers, std::uint64_t end);

/// A memory-mapped cache entry. Its arrays lie in the mapped file and are valid while `file()`
/// lives.
class CacheEntry {
 public:
  /// Opens a cache entry and checks its header and its checksum.
  /// \param known_checksum  the file's checksum, if it is known; otherwise the function hashes the
  ///                        file.
  /// \return nothing if the file does not exist.
  /// \throws InvalidInput if the file is damaged or has another version or another key.
  static std::optional<CacheEntry> open(const std::filesystem::path& cache, const CacheKey& key,
                                        const std::optional<Digest>& known_checksum = {});

  const std::shared_ptr<const MappedFile>& file() const { return file_; }
  /// The checksum that the end of the file states.
  const Digest& checksum() const { return checksum_; }

  /// An array in the file. \throws InvalidInput if the entry has no array with this name and type,
  /// or if floating-point numbers in the array are not valid coordinates (see
  /// are_in_coordinate_range).
  template <class T>
  std::span<const T> get(std::string_view name) const {
    using Element = detail::Element<T>;
    const StoredArray& row = find_array<typename Element::Number>(name);
    require_match(row.columns == Element::kNumbersPerElement);
    return {reinterpret_cast<const T*>(at(row)), row.rows};
  }
  /// A matrix in the file. \throws InvalidInput like `get`, or if the matrix has the wrong size.
  template <class Matrix>
  Eigen::Map<const Matrix> matrix(std::string_view name) const {
    using Number = typename Matrix::Scalar;
    const StoredArray& row = find_array<Number>(name);
    auto rows = static_cast<Index>(row.rows), columns = static_cast<Index>(row.columns);
    if (!Matrix::IsRowMajor) std::swap(rows, columns);
    constexpr Index kRows = Matrix::RowsAtCompileTime, kColumns = Matrix::ColsAtCompileTime;
    require_match((kRows == Eigen::Dynamic || kRows == rows) &&
                  (kColumns == Eigen::Dynamic || kColumns == columns));
    return {reinterpret_cast<const Number*>(at(row)), rows, columns};
  }

  /// Rejects the entry if a condition is false. Readers must check every number that they use as an
  /// index or a size: the checksum only proves that the file has not changed since it was written,
  /// not that the numbers were right.
  /// \throws InvalidInput if `holds` is false.
  void require(bool holds) const;
  /// Checks that no other process has shortened the file since it was opened. In a shortened file,
  /// the missing numbers of the mapped arrays read as zeros.
  /// \throws InvalidInput if the file was shortened.
  void throw_if_truncated() const;

 private:
  /// An array as the file describes it; see EntryArray.
  struct StoredArray {
    char name[24];             ///< name of the array, ending with a zero byte
    std::array<char, 4> type;  ///< name of the number type, see detail::number_type
    std::uint32_t columns;     ///< number of contiguous numbers in one element or matrix row
    std::uint64_t rows;        ///< number of elements or matrix rows
    /// offset of the array's first number from the start of the file, in bytes
    std::uint64_t offset;
  };
  friend void write_entry(const std::filesystem::path&, const CacheKey&,
                          const std::vector<EntryArray>&);

  /// The array with this name and with numbers of this type. \throws InvalidInput like `get`.
  template <class Number>
  const StoredArray& find_array(std::string_view name) const {
    const StoredArray& array = find_array(name, detail::number_type<Number>());
    if constexpr (std::is_floating_point_v<Number>) {
      require(are_in_coordinate_range(
          {reinterpret_cast<const Number*>(at(array)), array.rows * array.columns}));
    }
    return array;
  }
  const StoredArray& find_array(std::string_view name, const std::array<char, 4>& type) const;
  /// Address of the array's first number.
  const char* at(const StoredArray& array) const { return file_->bytes().data() + array.offset; }
  /// If `matches` is false, rejects the entry: it has another version or holds other data.
  void require_match(bool matches) const;
  /// If `fits` is false, rejects the entry: its size is wrong.
  void require_size_fits(bool fits) const;

  std::filesystem::path path_;
  std::shared_ptr<const MappedFile> file_;
  Digest checksum_;
  std::vector<StoredArray> arrays_;  ///< the arrays that the file lists
};

/// Reads values from an entry: `arrays("name", value)` accepts the same types as ArrayWriter. A
/// `value` that is a span is set to point into the mapped file.
/// \throws InvalidInput like CacheEntry::get.
class ArrayReader {
 public:
  explicit ArrayReader(const CacheEntry& entry) : entry_(entry) {}

  /// Reads an array with a single element.
  template <class T>
  void operator()(std::string_view name, T& value) const {
    const std::span<const T> values = entry_.get<T>(name);
    entry_.require(values.size() == 1);
    value = values.front();
  }
  /// Copies the elements of an array into a vector.
  template <class T>
  void operator()(std::string_view name, std::vector<T>& values) const {
    const std::span<const T> found = entry_.get<T>(name);
    values.assign(found.begin(), found.end());
  }
  /// Reads an array of bytes: each byte except 0 is true.
  void operator()(std::string_view name, std::vector<bool>& values) const {
    const auto found = entry_.get<std::uint8_t>(name);
    values.assign(found.begin(), found.end());
  }
  /// Sets the span to the array in the mapped file, without a copy.
  template <class T>
  void operator()(std::string_view name, std::span<const T>& values) const {
    values = entry_.get<T>(name);
  }
  /// Copies the numbers of an array into a matrix.
  template <class Scalar, int R, int C, int O>
  void operator()(std::string_view name, Eigen::Matrix<Scalar, R, C, O>& matrix) const {
    matrix = entry_.matrix<Eigen::Matrix<Scalar, R, C, O>>(name);
  }

 private:
  const CacheEntry& entry_;
};

}  // namespace crowdface

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

template <class T>
EntryArray array_of(std::string_view name, std::span<const T> values) {
  using Element = detail::Element<T>;
  return {std::string(name),
          detail::number_type<typename Element::Number>(),
          Element::kNumbers,
          values.size(),
          values.data(),
          values.size_bytes(),
          nullptr};
}
template <class T>
EntryArray array_of(std::string_view name, const std::vector<T>& values) {
  return array_of(name, std::span<const T>(values));
}
template <class Matrix>
EntryArray array_of(std::string_view name, const Eigen::PlainObjectBase<Matrix>& matrix) {
  using Number = typename Matrix::Scalar;
  return {std::string(name),
          detail::number_type<Number>(),
          static_cast<std::uint32_t>(matrix.innerSize()),
          static_cast<std::uint64_t>(matrix.outerSize()),
          matrix.data(),
          static_cast<std::uint64_t>(matrix.size()) * sizeof(Number),
          nullptr};
}
/// An array that owns its numbers. \param values  a vector or a matrix.
template <class T>
EntryArray owned_array(std::string_view name, T values) {
  const auto owner = std::make_shared<const T>(std::move(values));
  EntryArray array = array_of(name, *owner);
  array.owner = owner;
  return array;
}

/// An array of one element.
template <class T>
EntryArray value_array(std::string_view name, T value) {
  return owned_array(name, std::vector<T>{value});
}

/// Writes an entry. \throws CannotCreate, IoError.
void write_entry(const std::filesystem::path& cache, const CacheKey& key,
                 const std::vector<EntryArray>& arrays);

/// Larger numbers are no coordinates of a mesh, nor what smoothing makes of them.
inline constexpr double kLargestCoordinate = 1e9;
/// Whether no number is NaN, or larger than that.
bool are_coordinates(std::span<const float> values, float largest = kLargestCoordinate);
bool are_coordinates(std::span<const double> values, double largest = kLargestCoordinate);
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

  /// An array. \param largest  see are_coordinates; checked of floating-point numbers.
  /// \throws InvalidInput if the entry has no array of this name and type, or if it holds larger numbers.
  template <class T>
  std::span<const T> get(std::string_view name, double largest = kLargestCoordinate) const {
    using Element = detail::Element<T>;
    const Row& row = find<typename Element::Number>(name, largest);
    require_same(row.columns == Element::kNumbers);
    return {reinterpret_cast<const T*>(at(row)), row.rows};
  }
  /// A copy of an array.
  template <class T>
  std::vector<T> list(std::string_view name) const {
    const std::span<const T> values = get<T>(name);
    return {values.begin(), values.end()};
  }
  /// The element of an array of one. \throws InvalidInput as `get` does, also if there are more or none.
  template <class T>
  T value(std::string_view name) const {
    const std::span<const T> values = get<T>(name);
    require(values.size() == 1);
    return values.front();
  }
  /// A matrix. \throws InvalidInput as `get` does, also if a `Matrix` has another number of columns.
  template <class Matrix>
  Eigen::Map<const Matrix> matrix(std::string_view name,
                                  double largest = kLargestCoordinate) const {
    const Row& row = find<typename Matrix::Scalar>(name, largest);
    auto rows = static_cast<Index>(row.rows), columns = static_cast<Index>(row.columns);
    if (!Matrix::IsRowMajor) std::swap(rows, columns);
    require_same(Matrix::ColsAtCompileTime == Eigen::Dynamic ||
                 Matrix::ColsAtCompileTime == columns);
    return {reinterpret_cast<const typename Matrix::Scalar*>(at(row)), rows, columns};
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
  const Row& find(std::string_view name, double largest) const {
    const Row& row = find(name, detail::number_type<Number>());
    if constexpr (std::is_floating_point_v<Number>) {
      require(are_coordinates({reinterpret_cast<const Number*>(at(row)), row.rows * row.columns},
                              static_cast<Number>(largest)));
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

}  // namespace crowdface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/topology.h"

namespace crowdface::python {

/// Add the classes and functions of one subject to the module. python/crowdface/_crowdface.pyi
/// declares them for type checkers.
void bind_heads(pybind11::module_& module);
void bind_job(pybind11::module_& module);

/// Positions (V, 3) as an argument. An array of float64 in C order is passed without a copy.
using PositionsArray =
    pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A view of an array's rows. \throws InvalidInput unless the array has `rows` rows of three numbers.
inline Eigen::Map<const Positions> rows_of(const PositionsArray& array, Index rows,
                                           std::string_view name) {
  if (array.ndim() != 2 || array.shape(0) != rows || array.shape(1) != 3) {
    std::vector<std::string> shape;
    for (pybind11::ssize_t i = 0; i < array.ndim(); ++i) {
      shape.push_back(std::to_string(array.shape(i)));
    }
    throw InvalidInput(
        concat(name, ": expected an array (", rows, ", 3), found (", join(shape), ")"));
  }
  return {array.data(), rows, 3};
}

/// The value of a word. \throws UsageError that lists the words.
template <class Value>
Value value_of(const std::map<std::string, Value>& words, std::string_view name,
               const std::string& word) {
  if (const auto found = words.find(word); found != words.end()) return found->second;
  std::vector<std::string> all;
  for (const auto& entry : words) all.push_back(entry.first);
  throw UsageError(concat(name, ": expected ", join(all), ", found ", quoted(word)));
}

}  // namespace crowdface::python

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include <pybind11/pybind11.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface::python {

/// Add the classes and functions of one subject to the module. python/crowdface/_crowdface.pyi
/// declares them for type checkers.
void bind_heads(pybind11::module_& module);
void bind_job(pybind11::module_& module);

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

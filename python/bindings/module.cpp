// SPDX-License-Identifier: Apache-2.0
// The extension module crowdface._crowdface. It converts arguments and results; the Python package
// around it (python/crowdface) adds what needs no C++.
#include <memory>

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/version.h"
#include "crowdface/heads/cache_folder.h"

#include "bindings/bindings.h"

namespace crowdface::python {
namespace {

namespace py = pybind11;

/// Raises the class of crowdface.errors that belongs to the error's code.
void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(std::move(pointer));
  } catch (const Error& error) {
    const py::object raised = py::module_::import("crowdface.errors")
                                  .attr("error_of")(static_cast<int>(error.code()), error.what());
    PyErr_SetObject(py::type::of(raised).ptr(), raised.ptr());
  }
}

void limit_threads(int threads) {
  static std::unique_ptr<ThreadLimit> limit;
  limit.reset();
  if (threads > 0) limit = std::make_unique<ThreadLimit>(threads);
}

void choose_log_level(const std::string& level) {
  set_log_level(value_of<LogLevel>(
      {{"quiet", LogLevel::kQuiet}, {"normal", LogLevel::kNormal}, {"verbose", LogLevel::kVerbose}},
      "level", level));
}

}  // namespace

PYBIND11_MODULE(_crowdface, module) {
  py::register_exception_translator(translate);
  set_log_level(LogLevel::kQuiet);
  module.attr("__version__") = kVersion;
  module.def("set_threads", limit_threads, py::arg("threads"));
  module.def("set_log_level", choose_log_level, py::arg("level"));
  module.def("cache_directory", cache_directory);
  bind_heads(module);
  bind_job(module);
}

}  // namespace crowdface::python

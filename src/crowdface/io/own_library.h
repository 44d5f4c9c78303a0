// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// A function of one of our own shared libraries, which hold what some runs need and what takes long to load. Ours stand
/// beside the program, in the build as where they are installed; programs of others are linked with them.
/// \param library  "libcrowdface_images.so"; opened the first time, and never closed.
/// \param needs    "images need (OpenImageIO)". \param without  "images cannot be read": for messages.
/// \throws IoError if the library is not where it was installed, cannot be loaded, or lacks the function.
void* function_of_own_library(const char* library, const char* function, const char* needs,
                              const char* without);

/// From now on, while such a library is loaded, handlers of signals and of exit end the process with code 74 and a
/// message if a library aborts, calls exit, or waits longer than a minute: without memory or threads the libraries do
/// so. For programs, at their start: handlers and the alarm belong to the whole process.
void guard_start_of_libraries();

}  // namespace crowdface

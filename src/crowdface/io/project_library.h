// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Loads a function from one of the project's own shared libraries. These shared libraries contain
/// code that only some runs need, and link third-party libraries that are slow to load. The shared
/// libraries have the same place relative to the program in the build folder and after
/// installation.
/// \param library  "libcrowdface_images.so"; loaded at the first call, and never unloaded.
/// \param dependents_phrase  completes the error message "the libraries that … cannot be started",
///     for example with "images need (OpenImageIO)".
/// \param failure_phrase  beginning of all other error messages, such as "images cannot be read".
/// \throws IoError if the library is missing from its installed place, cannot be loaded, or lacks
///     the function.
void* load_library_function(const char* library, const char* function,
                            const char* dependents_phrase, const char* failure_phrase);

/// After this call, `load_library_function` installs handlers of signals and of exit while it loads
/// a library. If memory or threads run out, the library may abort, call exit, or hang. The handlers
/// then end the process with code 74 and a message, after a minute if the library hangs. Only a
/// program may call this function, at its start, because the handlers and the alarm belong to the
/// whole process.
void handle_crashes_during_library_loading();

}  // namespace crowdface

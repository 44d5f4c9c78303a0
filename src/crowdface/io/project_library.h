// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Loads a function from one of the project's own shared libraries. These shared libraries contain
/// code that only some runs need, and link third-party libraries that are slow to load. The shared
/// libraries have the same place relative to the program in the build folder and after
/// installation.
/// \param library  "libcrowdface_images.so"; loaded at the first call, and never unloaded.
/// \param dependents_phrase  who needs the libraries. It completes the error message "the libraries
///     that … cannot be started", for example with "images need (OpenImageIO)".
/// \param failure_phrase  beginning of all other error messages, such as "images cannot be read".
/// \throws IoError if the library is missing from its installed place, cannot be loaded, or lacks
///     the function.
void* load_library_function(const char* library, const char* function,
                            const char* dependents_phrase, const char* failure_phrase);

/// Makes load_library_function install handlers of signals and of exit while it loads a library. If
/// the library aborts, calls exit, or needs longer than a minute, the handlers end the process with
/// code 74 and a message; this happens when memory or threads run out. Only a program may call this
/// function, at its start, because the handlers and the alarm belong to the whole process.
void handle_crashes_during_library_loading();

}  // namespace crowdface

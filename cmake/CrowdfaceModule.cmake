# Builds each module of crowdface as one static library. Include paths begin at src/.

# Compiler flags of all targets. Results must have the same bits with every compiler: no contraction, no fast math.
add_library(crowdface_flags INTERFACE)
target_compile_options(crowdface_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 wrongly warns of overlapping copies in std::string's operator+ (GCC bug 105651).
  target_compile_options(crowdface_flags INTERFACE -Wno-restrict)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  # GCC 14 wrongly reports parts of Eigen's matrices in std::optional and std::vector as uninitialised. clang-tidy and valgrind
  # find uninitialised values.
  target_compile_options(crowdface_flags INTERFACE -Wno-maybe-uninitialized)
endif()
if(CROWDFACE_WERROR)
  target_compile_options(crowdface_flags INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(crowdface_flags INTERFACE -fpch-preprocess)  # for ccache
  # GCC treats the sources of a unity build as headers.
  target_compile_options(crowdface_flags INTERFACE -Wno-subobject-linkage)
endif()
if(CROWDFACE_FUZZ)
  # Coverage counters, from which scripts/fuzz.sh computes how much of each parser its corpus reaches.
  target_compile_options(crowdface_flags INTERFACE
    -fsanitize=fuzzer-no-link -fprofile-instr-generate -fcoverage-mapping)
  target_link_options(crowdface_flags INTERFACE -fprofile-instr-generate)
endif()
if(CROWDFACE_SANITIZE)
  target_compile_options(crowdface_flags INTERFACE
    -fsanitize=${CROWDFACE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(crowdface_flags INTERFACE -fsanitize=${CROWDFACE_SANITIZE})
endif()

# Precompiles headers that nearly all sources include. The dev preset, scripts/lint.sh and tests/structure (which compiles each
# header alone) do not use the precompiled headers, so they detect missing includes.
set(crowdface_prefix_headers
  <algorithm> <array> <cmath> <filesystem> <functional> <map> <optional> <set> <span> <string>
  <string_view> <vector> <Eigen/Core> <Eigen/Geometry>)
add_library(crowdface_prefix OBJECT ${PROJECT_SOURCE_DIR}/cmake/prefix.cpp)
target_link_libraries(crowdface_prefix PRIVATE crowdface_flags Eigen3::Eigen)
target_compile_features(crowdface_prefix PRIVATE cxx_std_20)
set_target_properties(crowdface_prefix PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_precompile_headers(crowdface_prefix PRIVATE ${crowdface_prefix_headers})

# All presets except `dev` compile several sources of a module together (CMAKE_UNITY_BUILD), which halves the build time.
# Therefore names in unnamed namespaces must be unique within a module. Sources with hwy/foreach_target.h include themselves
# once for each instruction set, so they are compiled alone.
function(crowdface_compile_kernels_alone)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} itself REGEX "hwy/foreach_target" LIMIT_COUNT 1)
    if(itself)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# crowdface_module(NAME SOURCES … [DEPENDS modules or public targets] [PRIVATE private targets] [NOT_INSTALLED])
function(crowdface_module name)
  cmake_parse_arguments(arg "NOT_INSTALLED" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
  add_library(crowdface_${name} STATIC ${arg_SOURCES})
  add_library(crowdface::${name} ALIAS crowdface_${name})
  crowdface_compile_kernels_alone(${arg_SOURCES})
  set_target_properties(crowdface_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(crowdface_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(crowdface_${name} PUBLIC cxx_std_20)
  target_link_libraries(crowdface_${name}
    PUBLIC ${arg_DEPENDS}
    PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:crowdface_flags>)
  target_precompile_headers(crowdface_${name} REUSE_FROM crowdface_prefix)
  if(NOT arg_NOT_INSTALLED)
    set_property(GLOBAL APPEND PROPERTY CROWDFACE_MODULES crowdface_${name})
  endif()
endfunction()

# Finds all third-party libraries. scripts/install_dependencies.sh installs them on Debian.
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)  # no version here: it would exclude Eigen 5, the major version after 3.4
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "crowdface needs Eigen 3.4 or newer; found ${Eigen3_VERSION} in ${Eigen3_DIR}")
endif()
find_package(TBB REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(yaml-cpp REQUIRED)
if(NOT TARGET yaml-cpp::yaml-cpp)  # until 0.7
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(Freetype REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenImageIO REQUIRED)
# Removes OpenCV's headers, which Debian's package of OpenImageIO lists but neither needs nor installs.
set_property(TARGET OpenImageIO::OpenImageIO PROPERTY INTERFACE_INCLUDE_DIRECTORIES
  ${OpenImageIO_INCLUDE_DIRS})
find_package(embree REQUIRED)
if(NOT embree_VERSION_MAJOR MATCHES "^[34]$")
  message(FATAL_ERROR "crowdface works with Embree 3 and Embree 4; found ${embree_VERSION} in ${embree_DIR}")
endif()
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_package(assimp REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
# On ARM, kernels are compiled only for NEON: Highway's other targets differ only in AES and bfloat16, or have vectors without
# a fixed size (SVE). On x86, kernels are compiled for the baseline, AVX2 and AVX-512; more targets would only slow the build.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(hwy_choice HWY_COMPILE_ONLY_STATIC)
elseif(hwy_VERSION VERSION_GREATER_EQUAL 1.0.6)
  set(hwy_choice "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_ZEN4|HWY_AVX3_SPR)")
else()  # older versions lack HWY_AVX3_ZEN4 and HWY_AVX3_SPR
  set(hwy_choice "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4)")
endif()
set_property(TARGET PkgConfig::hwy APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS "${hwy_choice}")
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)

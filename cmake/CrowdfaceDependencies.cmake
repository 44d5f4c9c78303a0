# Every third-party library, found once. scripts/install_dependencies.sh installs them on Debian.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(Freetype REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenImageIO REQUIRED)
# Debian's OpenImageIO names the headers of OpenCV too, which it neither needs nor installs.
set_property(TARGET OpenImageIO::OpenImageIO PROPERTY INTERFACE_INCLUDE_DIRECTORIES
  ${OpenImageIO_INCLUDE_DIRS})
find_package(embree REQUIRED)
if(NOT embree_VERSION_MAJOR MATCHES "^[34]$")
  message(FATAL_ERROR "crowdface works with Embree 3 and Embree 4; found ${embree_VERSION} in ${embree_DIR}")
endif()
find_package(meshoptimizer REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
# From cpp-httplib 0.15 on, Debian's header calls OpenSSL's libcrypto by itself.
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib libcrypto)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
# Kernels are compiled for the baseline (SSE2, NEON or Highway's emulation), AVX2 and AVX-512. Each further target would
# lengthen the build and speed up nothing; vectors of SVE have no fixed size, which the kernels need.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(hwy_disabled "HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128")
else()
  set(hwy_disabled "HWY_SSSE3|HWY_SSE4")
  if(hwy_VERSION VERSION_GREATER_EQUAL 1.0.6)  # earlier versions lack these names
    string(APPEND hwy_disabled "|HWY_AVX3_ZEN4|HWY_AVX3_SPR")
  endif()
endif()
set_property(TARGET PkgConfig::hwy APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS
  "HWY_DISABLED_TARGETS=(${hwy_disabled})")
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)

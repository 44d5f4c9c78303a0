# Every third-party library, found once. scripts/install_dependencies.sh installs them on Debian 12.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(OpenImageIO REQUIRED)
# Debian's OpenImageIO names the headers of OpenCV too, which it neither needs nor installs.
set_property(TARGET OpenImageIO::OpenImageIO PROPERTY INTERFACE_INCLUDE_DIRECTORIES
  ${OpenImageIO_INCLUDE_DIRS})
find_package(embree 3 REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)

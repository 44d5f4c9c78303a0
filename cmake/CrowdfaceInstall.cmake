# `cmake --install` installs the program, the libraries with their headers, and a CMake package. To use the package:
# find_package(crowdface), then link crowdface::run or another module.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY CROWDFACE_MODULES)
# Each component is a Debian package (scripts/package.sh). The program loads the shared libraries.
install(TARGETS crowdface COMPONENT program)
install(TARGETS crowdface_images crowdface_meshes EXPORT crowdfaceTargets COMPONENT program)
install(TARGETS ${modules} EXPORT crowdfaceTargets COMPONENT library)
# The public headers: crowdface.h and all headers that it includes, directly or indirectly.
set(unread crowdface/crowdface.h)
set(public_headers "")
while(unread)
  list(POP_FRONT unread header)
  if(header IN_LIST public_headers OR NOT EXISTS ${PROJECT_SOURCE_DIR}/src/${header})
    continue()  # version.h is generated
  endif()
  list(APPEND public_headers ${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/src/${header} includes REGEX "^#include \"")
  list(TRANSFORM includes REPLACE "^#include \"(.*)\".*" "\\1")
  list(APPEND unread ${includes})
endwhile()
foreach(header IN LISTS public_headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder}
    COMPONENT library)
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/crowdface DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT library FILES_MATCHING PATTERN "*.h")

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/crowdface)
install(EXPORT crowdfaceTargets NAMESPACE crowdface:: DESTINATION ${package_dir} COMPONENT library)
configure_package_config_file(cmake/crowdfaceConfig.cmake.in
  ${PROJECT_BINARY_DIR}/crowdfaceConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/crowdfaceConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/crowdfaceConfig.cmake ${PROJECT_BINARY_DIR}/crowdfaceConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT library)

# The gallery's page; missing if scripts/build_gallery.sh has not built it.
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/crowdface/gallery
  DESTINATION ${CMAKE_INSTALL_DATADIR}/crowdface OPTIONAL COMPONENT program PATTERN ".state" EXCLUDE)
install(DIRECTORY configs masks DESTINATION ${CMAKE_INSTALL_DATADIR}/crowdface COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# The manual page and the shell completions, which the program prints.
foreach(folder man bash-completion zsh fish)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/share/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program)
endforeach()

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# cpack makes two .deb: eccentra with launcher, libraries, solver, tools, studies, docs and cases, and eccentra-dev (EccentraExport.cmake).
# Below the folder of the documentation the pages are where README.md looks for them.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "_static" EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md" "${PROJECT_SOURCE_DIR}/CITATION.cff"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/cases" DESTINATION "${CMAKE_INSTALL_DATADIR}/eccentra" USE_SOURCE_PERMISSIONS
  PATTERN "results*" EXCLUDE PATTERN "run[0-9]*" EXCLUDE PATTERN ".eccentra-bin" EXCLUDE
  PATTERN "CMakeLists.txt" EXCLUDE PATTERN "run-coupled" EXCLUDE)

# The version is that of project(): where others read it, it is the same.
file(STRINGS "${PROJECT_SOURCE_DIR}/CITATION.cff" _cited REGEX "^version: ")
file(STRINGS "${PROJECT_SOURCE_DIR}/CHANGELOG.md" _changed REGEX "^## \\[[0-9]" LIMIT_COUNT 1)
if(NOT _cited STREQUAL "version: ${PROJECT_VERSION}" OR NOT _changed MATCHES "^## .${PROJECT_VERSION}]")
  message(FATAL_ERROR "CMakeLists.txt: the version is ${PROJECT_VERSION}, but CITATION.cff says '${_cited}' and the newest version in CHANGELOG.md is "
    "'${_changed}': all three must be the same")
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/CITATION.cff" "${PROJECT_SOURCE_DIR}/CHANGELOG.md")

# The program eccentra and the studies behind it: beside the build's programs it uses those of the source tree.
set(ECCENTRA_SCRIPTS "${PROJECT_SOURCE_DIR}/scripts")
configure_file("${PROJECT_SOURCE_DIR}/scripts/study/eccentra.in" "${PROJECT_BINARY_DIR}/bin/eccentra" @ONLY
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(ECCENTRA_SCRIPTS "../share/eccentra/scripts")
configure_file("${PROJECT_SOURCE_DIR}/scripts/study/eccentra.in" "${PROJECT_BINARY_DIR}/generated/eccentra-installed" @ONLY)
install(PROGRAMS "${PROJECT_BINARY_DIR}/generated/eccentra-installed" DESTINATION "${CMAKE_INSTALL_BINDIR}" RENAME eccentra)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scripts/study" DESTINATION "${CMAKE_INSTALL_DATADIR}/eccentra/scripts"
  PATTERN "__pycache__" EXCLUDE PATTERN "launch" EXCLUDE PATTERN "*.in.in" EXCLUDE PATTERN "eccentra.in" EXCLUDE)

include(EccentraExport)

# What Debian wants of a package: who holds which rights, and what has changed.
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/copyright" @ONLY CONTENT
[[Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: eccentra

Files: *
Copyright: Eccentra contributors
License: GPL-3.0-or-later
 On Debian systems the text of the GNU General Public License, version 3, is in /usr/share/common-licenses/GPL-3.
]])
install(FILES "${PROJECT_BINARY_DIR}/generated/copyright" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
execute_process(COMMAND gzip -9n INPUT_FILE "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  OUTPUT_FILE "${PROJECT_BINARY_DIR}/generated/changelog.gz")
install(FILES "${PROJECT_BINARY_DIR}/generated/changelog.gz" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # a package holds no tests: cpack need not build them
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME eccentra)
set(CPACK_PACKAGE_CONTACT "Eccentra contributors <eccentra@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Non-spherical particles in dense flows of yield-stress fluids")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
# The hosts' versions are part of what we are: both libraries are linked by their C++ symbols. Hosts that were built from source are no packages.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, python3, python3-matplotlib, xvfb, libgl1-mesa-dri")
if(NOT ECCENTRA_LIGGGHTS_DIR)
  execute_process(COMMAND dpkg-query -W -f "\${Version}" liggghts OUTPUT_VARIABLE _liggghts ERROR_QUIET)
  string(PREPEND CPACK_DEBIAN_PACKAGE_DEPENDS "liggghts (= ${_liggghts}), ")
endif()
if(NOT ECCENTRA_FOAM_DIR)
  execute_process(COMMAND dpkg-query -W -f "\${Version}" libopenfoam OUTPUT_VARIABLE _openfoam ERROR_QUIET)
  string(PREPEND CPACK_DEBIAN_PACKAGE_DEPENDS "openfoam (= ${_openfoam}), libopenfoam (= ${_openfoam}), ")
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME eccentra)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME eccentra-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "eccentra (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev, libqhull-dev, libopenmpi-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
include(CPack)

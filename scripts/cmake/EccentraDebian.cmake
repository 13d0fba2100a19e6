# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# cpack makes two .deb: eccentra with launcher, libraries, solver, tools, studies, docs and cases, and eccentra-dev (EccentraExport.cmake).
# What Debian wants of each: who holds which rights, what has changed.
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/copyright" @ONLY CONTENT
[[Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: eccentra

Files: *
Copyright: 2026 Eccentra contributors
License: GPL-3.0-or-later
 On Debian systems the text of the GNU General Public License, version 3, is in /usr/share/common-licenses/GPL-3.
]])
set(_contact "Eccentra contributors <eccentra@localhost>")
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+" _released "${_changed}")
execute_process(COMMAND "${CMAKE_COMMAND}" -E env LC_ALL=C TZ=UTC date -R -d "${_released}" OUTPUT_VARIABLE _released OUTPUT_STRIP_TRAILING_WHITESPACE)
foreach(_package eccentra eccentra-dev)
  set(_folder "${PROJECT_BINARY_DIR}/generated/${_package}")
  file(WRITE "${_folder}/changelog"
    "${_package} (${PROJECT_VERSION}) stable; urgency=medium\n\n  * /usr/share/doc/eccentra/CHANGELOG.md\n\n -- ${_contact}  ${_released}\n")
  execute_process(COMMAND gzip -9n INPUT_FILE "${_folder}/changelog" OUTPUT_FILE "${_folder}/changelog.gz")
endforeach()
install(FILES "${PROJECT_BINARY_DIR}/generated/copyright" "${PROJECT_BINARY_DIR}/generated/eccentra/changelog.gz" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES "${PROJECT_BINARY_DIR}/generated/copyright" "${PROJECT_BINARY_DIR}/generated/eccentra-dev/changelog.gz"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/eccentra-dev" COMPONENT development)

# What lintian reports and what is meant so.
file(WRITE "${PROJECT_BINARY_DIR}/generated/eccentra/overrides" "# The project has no mail address.
eccentra: bogus-mail-host Maintainer *
eccentra: bogus-mail-host-in-debian-changelog *
# The library calls functions of MPI alone.
eccentra: library-not-linked-against-libc [usr/lib/libeccentra_mpi_counters.so]
")
file(WRITE "${PROJECT_BINARY_DIR}/generated/eccentra-dev/overrides" "# The project has no mail address.
eccentra-dev: bogus-mail-host Maintainer *
eccentra-dev: bogus-mail-host-in-debian-changelog *
")
set(_overrides "${CMAKE_INSTALL_DATADIR}/lintian/overrides")
install(FILES "${PROJECT_BINARY_DIR}/generated/eccentra/overrides" DESTINATION "${_overrides}" RENAME eccentra)
install(FILES "${PROJECT_BINARY_DIR}/generated/eccentra-dev/overrides" DESTINATION "${_overrides}" RENAME eccentra-dev COMPONENT development)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # a package holds no tests: cpack need not build them
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME eccentra)
set(CPACK_PACKAGE_CONTACT "${_contact}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Non-spherical particles in dense flows of yield-stress fluids")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENT_UNSPECIFIED_DESCRIPTION "LIGGGHTS styles for clusters of spheres and rounded convex bodies, a solver\nfor the flow around them on OpenFOAM, and programs that make cases, run them\nand report.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, static libraries and CMake targets: closures, contact laws, shapes and\nthe link between two solvers.")
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
# ldconfig is a matter of dpkg's trigger.
file(WRITE "${PROJECT_BINARY_DIR}/generated/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/generated/triggers")
include(CPack)

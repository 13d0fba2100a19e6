# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# cpack makes a .deb of the launcher, libraries, solver, tools, docs and cases.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DOCDIR}" FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/cases" DESTINATION "${CMAKE_INSTALL_DATADIR}/eccentra" USE_SOURCE_PERMISSIONS
  PATTERN "results*" EXCLUDE PATTERN "run[0-9]*" EXCLUDE PATTERN ".eccentra-bin" EXCLUDE
  PATTERN "CMakeLists.txt" EXCLUDE PATTERN "run-coupled" EXCLUDE)

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
# The hosts' versions are part of what we are: both libraries are linked by their C++ symbols.
execute_process(COMMAND dpkg-query -W -f "\${Version}" liggghts OUTPUT_VARIABLE _liggghts ERROR_QUIET)
execute_process(COMMAND dpkg-query -W -f "\${Version}" libopenfoam OUTPUT_VARIABLE _openfoam ERROR_QUIET)
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "liggghts (= ${_liggghts}), openfoam (= ${_openfoam}), libopenfoam (= ${_openfoam}), openmpi-bin, python3, xvfb")
include(CPack)

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed beside the programs: docs, cases, studies. EccentraExport.cmake has what other projects link, EccentraDebian.cmake the .deb.
# Below the folder of the documentation the pages are where README.md looks for them.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "_static" EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md" "${PROJECT_SOURCE_DIR}/CITATION.cff" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
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
if(ECCENTRA_LIGGGHTS)
  configure_file("${PROJECT_SOURCE_DIR}/cases/run-coupled" "${PROJECT_BINARY_DIR}/bin/eccentra-run" @ONLY)
endif()
set(ECCENTRA_SCRIPTS "../share/eccentra/scripts")
configure_file("${PROJECT_SOURCE_DIR}/scripts/study/eccentra.in" "${PROJECT_BINARY_DIR}/generated/eccentra-installed" @ONLY)
install(PROGRAMS "${PROJECT_BINARY_DIR}/generated/eccentra-installed" DESTINATION "${CMAKE_INSTALL_BINDIR}" RENAME eccentra)
if(ECCENTRA_LIGGGHTS)
  configure_file("${PROJECT_SOURCE_DIR}/cases/run-coupled" "${PROJECT_BINARY_DIR}/generated/eccentra-run-installed" @ONLY)
  install(PROGRAMS "${PROJECT_BINARY_DIR}/generated/eccentra-run-installed" DESTINATION "${CMAKE_INSTALL_BINDIR}" RENAME eccentra-run)
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scripts/study" DESTINATION "${CMAKE_INSTALL_DATADIR}/eccentra/scripts"
  PATTERN "__pycache__" EXCLUDE PATTERN "launch" EXCLUDE PATTERN "*.in.in" EXCLUDE PATTERN "eccentra.in" EXCLUDE)

include(EccentraExport)

include(EccentraDebian)

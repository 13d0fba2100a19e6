# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Man pages, which are the pages of the programs in docs, and the completion of their command lines in bash.
set(ECCENTRA_PROGRAMS annulusFoam annulusMesh annulusReport clusterShape dragLaw eccentra eccentra-dem eccentra-keys eccentra-run)
foreach(_program IN LISTS ECCENTRA_PROGRAMS)
  install(FILES "${PROJECT_SOURCE_DIR}/scripts/completion.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
    RENAME "${_program}")
endforeach()

find_program(SPHINX_BUILD sphinx-build PATHS /usr/bin NO_DEFAULT_PATH)
if(SPHINX_BUILD)
  file(GLOB _pages CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/docs/*.md" "${PROJECT_SOURCE_DIR}/docs/benchmarks/*.md")
  list(TRANSFORM ECCENTRA_PROGRAMS PREPEND "${PROJECT_BINARY_DIR}/man/" OUTPUT_VARIABLE _manuals)
  list(TRANSFORM _manuals APPEND .1)
  list(TRANSFORM _manuals APPEND .gz OUTPUT_VARIABLE _packed)
  add_custom_command(OUTPUT ${_manuals} ${_packed} DEPENDS "${PROJECT_SOURCE_DIR}/docs/conf.py" ${_pages}
    COMMAND "${SPHINX_BUILD}" -q -b man -d "${PROJECT_BINARY_DIR}/man/.doctrees" "${PROJECT_SOURCE_DIR}/docs" "${PROJECT_BINARY_DIR}/man"
    COMMAND gzip -9nkf ${_manuals}
    COMMENT "Man pages" VERBATIM)
  add_custom_target(eccentra-man ALL DEPENDS ${_manuals})
  install(FILES ${_packed} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
endif()

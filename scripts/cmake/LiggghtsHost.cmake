# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# The stock LIGGGHTS, as the interface target liggghts_host: Debian's package, or (ECCENTRA_LIGGGHTS_DIR) a LIGGGHTS-PUBLIC that
# was built in its own src folder with its shared library.
set(ECCENTRA_LIGGGHTS_DIR "" CACHE PATH "Folder of LIGGGHTS-PUBLIC built from source; empty: Debian's package")
if(ECCENTRA_LIGGGHTS_DIR)
  set(_own HINTS "${ECCENTRA_LIGGGHTS_DIR}/src" NO_DEFAULT_PATH)
  find_path(LIGGGHTS_INCLUDE_DIR lammps.h ${_own})
  find_library(LIGGGHTS_LIBRARY NAMES liggghts lmp_auto lmp_fedora lmp ${_own})
  find_program(LIGGGHTS_EXECUTABLE NAMES liggghts lmp_auto lmp_fedora lmp ${_own})
  if(NOT LIGGGHTS_INCLUDE_DIR OR NOT LIGGGHTS_LIBRARY OR NOT LIGGGHTS_EXECUTABLE)
    message(FATAL_ERROR "ECCENTRA_LIGGGHTS_DIR: '${ECCENTRA_LIGGGHTS_DIR}' has no src/lammps.h beside the program lmp_auto and its "
      "library liblmp_auto.so: build LIGGGHTS-PUBLIC there with 'make auto' and 'make -f Makefile.shlib auto'")
  endif()
  list(APPEND CMAKE_INSTALL_RPATH "${ECCENTRA_LIGGGHTS_DIR}/src")
else()
  find_path(LIGGGHTS_INCLUDE_DIR lammps.h PATH_SUFFIXES liggghts)
  find_library(LIGGGHTS_LIBRARY liggghts)
  find_program(LIGGGHTS_EXECUTABLE liggghts)
endif()
if(NOT LIGGGHTS_INCLUDE_DIR OR NOT LIGGGHTS_LIBRARY OR NOT LIGGGHTS_EXECUTABLE)
  message(FATAL_ERROR "LIGGGHTS is not installed: run scripts/setup (packages liggghts and libliggghts-dev)")
endif()

# The development package lacks the lists of contact models that contact_models.h includes: make them from the headers.
set(_generated "${PROJECT_BINARY_DIR}/generated/liggghts")
file(MAKE_DIRECTORY "${_generated}")
foreach(_kind surface normal tangential cohesion rolling)
  file(GLOB _models RELATIVE "${LIGGGHTS_INCLUDE_DIR}" "${LIGGGHTS_INCLUDE_DIR}/${_kind}_model_*.h")
  list(FILTER _models EXCLUDE REGEX "_model_base\\.h$")
  list(SORT _models)
  set(_text "")
  foreach(_model IN LISTS _models)
    string(APPEND _text "#include \"${_model}\"\n")
  endforeach()
  if(_kind STREQUAL "rolling")
    # Ours; each is empty until its own header is seen through liggghts-plugins/styles/rolling.
    string(APPEND _text "#include \"styles/rolling/rolling_models.h\"\n")
  endif()
  file(CONFIGURE OUTPUT "${_generated}/style_${_kind}_model.h" CONTENT "${_text}" @ONLY)
endforeach()
file(CONFIGURE OUTPUT "${_generated}/style_contact_model.h" CONTENT "" @ONLY)

# A LIGGGHTS that was built from source has such lists beside contact_models.h, which would find those first: copies of its headers without them. (The
# compiler would follow links of system headers to the folder that they point to.)
set(_headers "${LIGGGHTS_INCLUDE_DIR}")
if(ECCENTRA_LIGGGHTS_DIR)
  set(_headers "${PROJECT_BINARY_DIR}/generated/liggghts-headers")
  file(MAKE_DIRECTORY "${_headers}")
  file(GLOB _names RELATIVE "${LIGGGHTS_INCLUDE_DIR}" "${LIGGGHTS_INCLUDE_DIR}/*.h")
  list(FILTER _names EXCLUDE REGEX "^style_[a-z]+_model\\.h$")
  foreach(_name IN LISTS _names)
    configure_file("${LIGGGHTS_INCLUDE_DIR}/${_name}" "${_headers}/${_name}" COPYONLY)
  endforeach()
endif()

# The version that we build against: the guard in styles/entry/ compares it with the one that loads us.
execute_process(COMMAND ${CMAKE_COMMAND} -E env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    ${LIGGGHTS_EXECUTABLE} -in /dev/null -log none
  OUTPUT_VARIABLE _banner ERROR_QUIET WORKING_DIRECTORY "${PROJECT_BINARY_DIR}")
if(NOT _banner MATCHES "LIGGGHTS-[A-Z]+ ([0-9]+\\.[0-9]+\\.[0-9]+)")
  message(FATAL_ERROR "could not read the version that '${LIGGGHTS_EXECUTABLE}' prints: ${_banner}")
endif()
set(LIGGGHTS_VERSION "${CMAKE_MATCH_1}")
message(STATUS "LIGGGHTS ${LIGGGHTS_VERSION} at ${LIGGGHTS_LIBRARY}")

add_library(liggghts_host INTERFACE)
target_include_directories(liggghts_host SYSTEM INTERFACE "${_generated}" "${_headers}")
target_compile_definitions(liggghts_host INTERFACE OMPI_SKIP_MPICXX ECCENTRA_LIGGGHTS_VERSION="${LIGGGHTS_VERSION}")
# Superquadrics, which the makefile of LIGGGHTS has switched on and Debian has not, add members to the structures of contacts.
execute_process(COMMAND "${CMAKE_NM}" -D --defined-only "${LIGGGHTS_LIBRARY}" OUTPUT_VARIABLE _symbols RESULT_VARIABLE _unread)
if(_unread)
  message(FATAL_ERROR "'${CMAKE_NM}' could not read the symbols of '${LIGGGHTS_LIBRARY}'")
endif()
if(_symbols MATCHES "AtomVecSuperquadric")
  message(STATUS "LIGGGHTS was built with superquadrics")
  target_compile_definitions(liggghts_host INTERFACE SUPERQUADRIC_ACTIVE_FLAG NONSPHERICAL_ACTIVE_FLAG)
endif()
target_link_libraries(liggghts_host INTERFACE "${LIGGGHTS_LIBRARY}" MPI::MPI_CXX ${CMAKE_DL_LIBS})

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# The OpenFOAM that we build against, as the interface target openfoam_host: Debian's package with headers from its source
# package, or (ECCENTRA_FOAM_DIR) ESI's own installation, v1912 or later, with the headers that it has.
set(ECCENTRA_FOAM_DIR "" CACHE PATH "WM_PROJECT_DIR of ESI's OpenFOAM; empty: Debian's package")
set(ECCENTRA_FOAM_LIBRARIES "" CACHE PATH "FOAM_LIBBIN of that OpenFOAM")
set(ECCENTRA_FOAM_MPI "sys-openmpi" CACHE STRING "FOAM_MPI of that OpenFOAM: the folder of its Pstream")
set(ECCENTRA_FOAM_HEADERS "${PROJECT_SOURCE_DIR}/build/openfoam-headers" CACHE PATH
  "Folder of flat header folders that scripts/setup makes from the Debian source package")
set(_hints "")
if(ECCENTRA_FOAM_DIR)
  set(_headers "${ECCENTRA_FOAM_DIR}/src")
  set(_hints HINTS "${ECCENTRA_FOAM_LIBRARIES}" "${ECCENTRA_FOAM_LIBRARIES}/${ECCENTRA_FOAM_MPI}" NO_DEFAULT_PATH)
  if(NOT EXISTS "${ECCENTRA_FOAM_DIR}/META-INFO/api-info" OR NOT EXISTS "${_headers}/OpenFOAM/lnInclude")
    message(FATAL_ERROR "ECCENTRA_FOAM_DIR: '${ECCENTRA_FOAM_DIR}' is no OpenFOAM of ESI with headers (META-INFO/api-info and "
      "src/OpenFOAM/lnInclude): source its etc/bashrc, or install its -dev package")
  endif()
  file(STRINGS "${ECCENTRA_FOAM_DIR}/META-INFO/api-info" _api REGEX "^api=")
  string(REGEX REPLACE "^api=" "" ECCENTRA_FOAM_API "${_api}")
else()
  set(_headers "${ECCENTRA_FOAM_HEADERS}")
  if(NOT EXISTS "${_headers}/TurbulenceModels/phaseIncompressible/lnInclude")
    message(FATAL_ERROR "no OpenFOAM headers in ${_headers}: run scripts/setup")
  endif()
  # Headers of another version than the installed library's compile, and then crash.
  file(STRINGS "${_headers}/version" _headers_version LIMIT_COUNT 1)
  execute_process(COMMAND dpkg-query -W -f "\${source:Version}" libopenfoam OUTPUT_VARIABLE _library_version ERROR_QUIET)
  if(NOT "${_headers_version}" STREQUAL "${_library_version}")
    message(FATAL_ERROR "the OpenFOAM headers in ${_headers} are of version '${_headers_version}', the installed "
      "library is of version '${_library_version}': run scripts/setup, which fetches the headers that match")
  endif()
  string(REGEX MATCH "^[0-9]+" ECCENTRA_FOAM_API "${_headers_version}")
endif()
message(STATUS "OpenFOAM v${ECCENTRA_FOAM_API} in ${_headers}")

add_library(openfoam_host INTERFACE)
# __restrict__: g++ 12, 13 and 14 make wrong numbers of OpenFOAM's in-place field operators with it; tests/flow guards this line.
target_compile_definitions(openfoam_host INTERFACE
  OPENFOAM=${ECCENTRA_FOAM_API} WM_DP WM_LABEL_SIZE=32 NoRepository OMPI_SKIP_MPICXX "__restrict__=")
# -ftrapping-math: OpenFOAM traps floating-point errors, so a guarded division must not be computed speculatively. Name
# openfoam_host after eccentra_options, whose opposite would otherwise win.
target_compile_options(openfoam_host INTERFACE -ftemplate-depth-100 -pthread -ftrapping-math)
set(_folders OpenFOAM OSspecific/POSIX finiteVolume meshTools transportModels)
if(ECCENTRA_FOAM_API GREATER_EQUAL 2006)
  list(APPEND _folders fileFormats surfMesh) # taken out of meshTools
endif()
foreach(_library IN LISTS _folders)
  target_include_directories(openfoam_host SYSTEM INTERFACE "${_headers}/${_library}/lnInclude")
endforeach()
target_include_directories(openfoam_host SYSTEM INTERFACE "${_headers}/transportModels")
foreach(_library finiteVolume meshTools incompressibleTransportModels OpenFOAM Pstream)
  find_library(FOAM_${_library}_LIBRARY ${_library} ${_hints} REQUIRED)
  target_link_libraries(openfoam_host INTERFACE "${FOAM_${_library}_LIBRARY}")
endforeach()
if(ECCENTRA_FOAM_DIR)
  list(APPEND CMAKE_INSTALL_RPATH "${ECCENTRA_FOAM_LIBRARIES}" "${ECCENTRA_FOAM_LIBRARIES}/${ECCENTRA_FOAM_MPI}")
endif()
target_link_libraries(openfoam_host INTERFACE MPI::MPI_CXX ${CMAKE_DL_LIBS} m)

# The turbulence models of the same library, of which a laminar flow needs what function objects look up.
add_library(openfoam_turbulence INTERFACE)
target_link_libraries(openfoam_turbulence INTERFACE openfoam_host)
foreach(_library turbulenceModels incompressible phaseIncompressible)
  target_include_directories(openfoam_turbulence SYSTEM INTERFACE
    "${_headers}/TurbulenceModels/${_library}/lnInclude")
endforeach()
foreach(_library incompressibleTurbulenceModels turbulenceModels)
  find_library(FOAM_${_library}_LIBRARY ${_library} ${_hints} REQUIRED)
  target_link_libraries(openfoam_turbulence INTERFACE "${FOAM_${_library}_LIBRARY}")
endforeach()
# With equations for a fluid that shares its space; flow/turbulence alone links it.
find_library(FOAM_DPMTurbulenceModels_LIBRARY DPMTurbulenceModels ${_hints} REQUIRED)

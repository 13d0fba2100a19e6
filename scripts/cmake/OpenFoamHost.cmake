# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# The stock OpenFOAM that Debian installs, as the interface target openfoam_host; its headers come from the source package.
set(ECCENTRA_FOAM_HEADERS "${PROJECT_SOURCE_DIR}/build/openfoam-headers" CACHE PATH
  "Folder of flat header folders that scripts/setup makes from the Debian source package")
if(NOT EXISTS "${ECCENTRA_FOAM_HEADERS}/TurbulenceModels/phaseIncompressible/lnInclude")
  message(FATAL_ERROR "no OpenFOAM headers in ${ECCENTRA_FOAM_HEADERS}: run scripts/setup")
endif()
# Headers of another version than the installed library's compile, and then crash.
file(STRINGS "${ECCENTRA_FOAM_HEADERS}/version" _headers_version LIMIT_COUNT 1)
execute_process(COMMAND dpkg-query -W -f "\${source:Version}" libopenfoam OUTPUT_VARIABLE _library_version ERROR_QUIET)
if(NOT "${_headers_version}" STREQUAL "${_library_version}")
  message(FATAL_ERROR "the OpenFOAM headers in ${ECCENTRA_FOAM_HEADERS} are of version '${_headers_version}', the installed "
    "library is of version '${_library_version}': run scripts/setup, which fetches the headers that match")
endif()

add_library(openfoam_host INTERFACE)
# __restrict__: g++ 12 makes wrong numbers of OpenFOAM's in-place field operators with it; tests/flow guards this line.
target_compile_definitions(openfoam_host INTERFACE
  OPENFOAM=1912 WM_DP WM_LABEL_SIZE=32 NoRepository OMPI_SKIP_MPICXX "__restrict__=")
# -ftrapping-math: OpenFOAM traps floating-point errors, so a guarded division must not be computed speculatively. Name
# openfoam_host after eccentra_options, whose opposite would otherwise win.
target_compile_options(openfoam_host INTERFACE -ftemplate-depth-100 -pthread -ftrapping-math)
foreach(_library OpenFOAM OSspecific/POSIX finiteVolume meshTools transportModels)
  target_include_directories(openfoam_host SYSTEM INTERFACE "${ECCENTRA_FOAM_HEADERS}/${_library}/lnInclude")
endforeach()
target_include_directories(openfoam_host SYSTEM INTERFACE "${ECCENTRA_FOAM_HEADERS}/transportModels")
foreach(_library finiteVolume meshTools incompressibleTransportModels OpenFOAM Pstream)
  find_library(FOAM_${_library}_LIBRARY ${_library} REQUIRED)
  target_link_libraries(openfoam_host INTERFACE "${FOAM_${_library}_LIBRARY}")
endforeach()
target_link_libraries(openfoam_host INTERFACE MPI::MPI_CXX ${CMAKE_DL_LIBS} m)

# The turbulence models of the same library, of which a laminar flow needs what function objects look up.
add_library(openfoam_turbulence INTERFACE)
target_link_libraries(openfoam_turbulence INTERFACE openfoam_host)
foreach(_library turbulenceModels incompressible phaseIncompressible)
  target_include_directories(openfoam_turbulence SYSTEM INTERFACE
    "${ECCENTRA_FOAM_HEADERS}/TurbulenceModels/${_library}/lnInclude")
endforeach()
foreach(_library incompressibleTurbulenceModels turbulenceModels)
  find_library(FOAM_${_library}_LIBRARY ${_library} REQUIRED)
  target_link_libraries(openfoam_turbulence INTERFACE "${FOAM_${_library}_LIBRARY}")
endforeach()

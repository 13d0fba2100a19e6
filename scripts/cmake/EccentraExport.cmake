# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# find_package(eccentra) for others: the libraries that know no solver, and the link. Component development, package eccentra-dev.
include(CMakePackageConfigHelpers)
set(_libraries base shape contact closures link)
set(_targets eccentra_options eccentra_flow_quantities eccentra_base eccentra_shape eccentra_contact eccentra_closures)
# eccentra_link, a shared library that programs need too, is installed and added to this export in openfoam-coupling/link.
foreach(_library IN LISTS _libraries)
  set_target_properties(eccentra_${_library} PROPERTIES EXPORT_NAME ${_library})
endforeach()
set_target_properties(eccentra_flow_quantities PROPERTIES EXPORT_NAME flow_quantities)
install(TARGETS ${_targets} EXPORT eccentra ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
foreach(_library base shape contact closures)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/liggghts-plugins/${_library}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/eccentra" COMPONENT development
    FILES_MATCHING PATTERN "*.h" PATTERN "vtk" EXCLUDE)
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/openfoam-coupling/link" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/eccentra" COMPONENT development
  FILES_MATCHING PATTERN "*.h")

# Eigen aligns its small arrays by the vector units that the compiler may use, so that the layout of a class with such a member follows from the
# flags of each file. Who includes our headers gets the alignment that the libraries were built with.
if(NOT DEFINED CACHE{ECCENTRA_EIGEN_ALIGNMENT})
  file(WRITE "${PROJECT_BINARY_DIR}/generated/eigen_alignment.cpp" "#include <Eigen/Core>\nalignment=EIGEN_MAX_STATIC_ALIGN_BYTES=end\n")
  get_target_property(_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  set(_native "")
  if(ECCENTRA_NATIVE)
    set(_native -march=native)
  endif()
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" ${_native} -std=c++17 -isystem "${_include}" -E -P "${PROJECT_BINARY_DIR}/generated/eigen_alignment.cpp"
    OUTPUT_VARIABLE _expanded ERROR_QUIET)
  if(NOT _expanded MATCHES "alignment=[ \n]*([0-9]+)[ \n]*=end")
    message(FATAL_ERROR "Eigen in '${_include}' does not say EIGEN_MAX_STATIC_ALIGN_BYTES: install libeigen3-dev 3.4")
  endif()
  set(ECCENTRA_EIGEN_ALIGNMENT "${CMAKE_MATCH_1}" CACHE INTERNAL "Alignment of Eigen's small arrays in bytes")
endif()
target_compile_definitions(eccentra_base INTERFACE
  $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=${ECCENTRA_EIGEN_ALIGNMENT}>
  $<INSTALL_INTERFACE:EIGEN_MAX_STATIC_ALIGN_BYTES=${ECCENTRA_EIGEN_ALIGNMENT}>)

set(_folder "${CMAKE_INSTALL_LIBDIR}/cmake/eccentra")
install(EXPORT eccentra NAMESPACE eccentra:: FILE eccentraTargets.cmake DESTINATION "${_folder}" COMPONENT development)
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/eccentraConfig.cmake.in" "${PROJECT_BINARY_DIR}/generated/eccentraConfig.cmake"
  INSTALL_DESTINATION "${_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/generated/eccentraConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/generated/eccentraConfig.cmake" "${PROJECT_BINARY_DIR}/generated/eccentraConfigVersion.cmake"
  DESTINATION "${_folder}" COMPONENT development)

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# The scripts: caches that know all their inputs, no result that depends on the language, one sentence where nothing can be written.
find_program(ECCENTRA_SYSTEM_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
foreach(_row caches_of_studies caches_know_their_files second_call_of_compare_rolling comma_locale read_only_checkout)
  add_test(NAME reported.${_row} COMMAND ${ECCENTRA_SYSTEM_PYTHON} -B "${CMAKE_CURRENT_LIST_DIR}/scripts_test.py" --verbose Reported.test_${_row})
  math(EXPR _timeout "900 * ${ECCENTRA_TIMEOUT_FACTOR}")
  set_tests_properties(reported.${_row} PROPERTIES LABELS interface TIMEOUT ${_timeout} SKIP_RETURN_CODE 77
    ENVIRONMENT "${ECCENTRA_TEST_ENVIRONMENT};ECCENTRA_BUILD=${PROJECT_BINARY_DIR}")
endforeach()

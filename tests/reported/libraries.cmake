# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
set(_programs clusterShape annulusReport eccentra-keys)
if(ECCENTRA_OPENFOAM)
  list(APPEND _programs annulusFoam annulusMesh)
endif()
eccentra_reported(libraries ROWS library_in_the_working_folder DEPENDS ${_programs}
  ENVIRONMENT "ECCENTRA_BUILD=${PROJECT_BINARY_DIR}")

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
eccentra_reported(libraries ROWS library_in_the_working_folder DEPENDS clusterShape annulusReport
  ENVIRONMENT "ECCENTRA_BUILD=${PROJECT_BINARY_DIR}")

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# What two sides of a run describe twice, what goes wrong on one of them, and who disturbs them.
if(ECCENTRA_OPENFOAM)
  eccentra_reported(geometry
    ROWS geometry_of_one_side_alone geometry_of_one_side_alone_over_the_socket geometry_of_one_side_alone_on_two_ranks
      particles_outside_the_mesh particles_outside_the_mesh_on_two_ranks which_particle_has_left
    DEPENDS annulusFoam annulusMesh ENVIRONMENT "ECCENTRA_CASES=${PROJECT_SOURCE_DIR}/cases")
  eccentra_reported(errors
    ROWS error_on_proc_of_a_hosted_script error_on_proc_of_a_hosted_script_on_two_ranks errors_end_with_the_sentence
      comma_locale_of_programs
    DEPENDS annulusFoam annulusMesh annulusReport clusterShape eccentra-keys
    ENVIRONMENT "ECCENTRA_CASES=${PROJECT_SOURCE_DIR}/cases")
  eccentra_reported(strangers ROWS stranger_on_tcp stranger_on_tcp_on_two_ranks
    LIBRARIES eccentra_link "${ECCENTRA_ZMQ_LIBRARY}"
    DEPENDS annulusFoam annulusMesh ENVIRONMENT "ECCENTRA_CASES=${PROJECT_SOURCE_DIR}/cases")
endif()

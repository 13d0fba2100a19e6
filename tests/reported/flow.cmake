# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# What users of OpenFOAM bring and expect (habits_test.cpp), and their runs (flow_test.cpp).
if(ECCENTRA_OPENFOAM)
  eccentra_reported(habits
    ROWS openfoam_habits_fvOptions openfoam_habits_MRF openfoam_habits_RAS openfoam_habits_function_objects
      adversary_17_openfoam_folder_missing issue_files_that_stock_solvers_read issue_function_object_types
      issue_boundary_types issue_unread_entries
    LIBRARIES -Wl,--no-as-needed eccentraFlow eccentraRheology
    DEPENDS annulusFoam annulusMesh TIMEOUT 200)
  eccentra_reported(flow
    ROWS issue_measures_of_a_single_phase_run water_at_Re_3e5 adversary_16_drive_across_a_closed_direction
      adversary_17_space_in_the_case_folder adversary_19_annulusMesh issue_not_converged_within_the_step
      inlet_fixedValue_below_a_settled_bed issue_function_objects_of_a_coupled_run adversary_17_mostSolid
      adversary_17_half_written_time
    LIBRARIES -Wl,--no-as-needed eccentraFlow eccentraRheology
    DEPENDS annulusFoam annulusMesh TIMEOUT 200)
endif()

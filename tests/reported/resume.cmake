# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Interrupted runs, disks that are full, and the cases' own `run`.
if(ECCENTRA_OPENFOAM)
  set(_of_runs DEPENDS annulusFoam annulusMesh LABELS coupled TIMEOUT 200 ENVIRONMENT "ECCENTRA_CASES=${PROJECT_SOURCE_DIR}/cases")
  eccentra_reported(resume ROWS
      adversary_2_shorter_coupling_csv adversary_2b_a_forgotten_resume adversary_2b_newer_checkpoints_are_kept
      adversary_5_another_mesh adversary_5_another_interval_or_step resume_script_that_does_not_read_the_checkpoint
      resume_any_script_goes_on_from_any_signal resume_beside_fields_that_a_kill_left_in_pieces
    LIBRARIES eccentra_link ${_of_runs})
  eccentra_reported(resume_heap ROWS
      adversary_12_a_resumed_run_that_inserts adversary_12_a_resumed_run_that_inserts_on_two_ranks resume_every_insertion
      resume_heap_alone
    ${_of_runs})
  eccentra_reported(case_run ROWS
      readme_ctrl_c_in_tomren_section_then_resume resume_over_the_socket_on_two_ranks readme_cp_r_tomren_section_run
      refused_run_has_nothing_to_go_on_with readme_output_a_b adversary_15_words_of_run run_with_a_turbulence_model adversary_17_names_of_folders adversary_4_comma_locale
    ${_of_runs})
  eccentra_reported(full_disk ROWS
      adversary_1_disk_full_for_a_moment adversary_1b_dump_cluster_vtk_on_a_full_disk
      adversary_14_standard_output_on_a_full_disk
    LIBRARIES eccentra_link ${_of_runs})
  eccentra_reported(kills ROWS twenty_kills_on_the_shipped_cases DEPENDS annulusFoam annulusMesh LABELS slow TIMEOUT 3000
    ENVIRONMENT "ECCENTRA_CASES=${PROJECT_SOURCE_DIR}/cases")
endif()

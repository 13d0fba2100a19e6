# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Stock styles and commands in scenes with clusters.
eccentra_reported(styles
  ROWS heat_gran heat_gran_conduction cluster_in_no_integrator cluster_in_two_integrators move_rotate
    rigid_beside_nve_cluster refused_with_bodies_there refused_before_a_run refused_for_late_bodies groups_of_plain_spheres
    nothing_refused_without_clusters
  LIBRARIES eccentra liggghts_host)
eccentra_reported(styles_table
  ROWS stock_styles_are_all_in_the_table commands_are_all_in_the_table page_of_stock_styles
  LIBRARIES eccentra liggghts_host)
eccentra_reported(stock_commands
  ROWS set_diameter set_density set_mass set_omega displace_atoms_rotate displace_atoms_rotate_bed clear clear_in_loop
    delete_atoms delete_atoms_in_a_bed
  LIBRARIES eccentra liggghts_host)
eccentra_reported(damaged_state
  ROWS damaged_restart_file restart_without_clusters changed_behind_our_back
  LIBRARIES eccentra liggghts_host)

# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
eccentra_reported(words
  ROWS run_every overlap_at_border density_uniform insert_orientation_constant gran_cluster_without_tangential
    wall_rolling_with_clusters_only second_pour_of_smaller_bodies unread_material_property copied_case_with_another_grain
    dump_columns_of_bodies keywords_of_stock_styles)

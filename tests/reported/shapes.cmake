# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# Shapes from files: what is not one body is named, what is repaired is said, what was chosen stays.
eccentra_reported(meshes
  ROWS stl_two_bodies stl_own_size clump_of_stl_mass_solid stl_flake_with_overlapping_sliver stl_of_several_solids
       stl_that_is_not_closed_or_not_readable stl_that_is_repaired stl_missing_volume stl_cover_balanced stl_in_millimetres
  LIBRARIES eccentra_stl
  DEPENDS clusterShape)
eccentra_reported(shapes
  ROWS clump_of_public_generators clump_that_is_no_list_of_spheres clump_spheres_that_coincide clump_read_by_stock
       empty_words_of_shape_tools full_standard_output_of_shape_tools
  LIBRARIES eccentra_stl
  DEPENDS clusterShape eccentra-keys annulusReport)

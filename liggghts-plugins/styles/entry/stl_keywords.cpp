// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes STL shapes known in LIGGGHTS as soon as libeccentra is loaded.
#include "shape/vtk/hull_of_stl.h"
#include "shape/vtk/stl_shape.h"

namespace {
[[maybe_unused]] const bool installed =
    (eccentra::shape::install_stl_keywords(), eccentra::shape::install_hull_words(), true);
}

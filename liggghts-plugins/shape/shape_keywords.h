// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of reading shape arguments that the reader of STL shapes, which lives with VTK, shares.
#pragma once

#include "shape/cluster_shape.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Word `index`; throws std::invalid_argument saying that `need` is missing where the arguments end before.
const std::string& word_at(const std::vector<std::string>& arguments, std::size_t index, const std::string& need);
/// Throw std::invalid_argument naming `what` and the word unless it is a number greater than 0.
long whole_number(const std::string& word, const std::string& what);
double positive_number(const std::string& word, const std::string& what);

/// Multiplies all lengths.
void resize(std::vector<Sphere>& spheres, MassProperties& properties, double scale);

/// Reader of `stl ...` arguments, see make_shape. Without one, make_shape says how to make a .clump of the STL file
/// first.
using StlMaker = ClusterShape (*)(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                                  double diameter);
void install_stl_maker(StlMaker maker);

} // namespace eccentra::shape

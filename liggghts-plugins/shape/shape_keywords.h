// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What families of shapes share when they read their arguments.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Word `index`; throws std::invalid_argument saying that `need` is missing where the arguments end before.
const std::string& word_at(const std::vector<std::string>& arguments, std::size_t index, const std::string& need);
/// Throw std::invalid_argument naming `what` and the word unless it is a number greater than 0.
long whole_number(const std::string& word, const std::string& what);
double positive_number(const std::string& word, const std::string& what);

/// Factor that gives volume `volume` the equivalent diameter asked for.
double scale_to_diameter(double volume, double diameter);
/// Multiplies all lengths.
void resize(std::vector<Sphere>& spheres, MassProperties& properties, double scale);

/// The union of these spheres at the diameter [m] of the sphere of equal volume; throws std::invalid_argument where
/// none is given.
ClusterShape sized_shape(const std::string& name, std::vector<Sphere> spheres, double diameter);

/// As make_shape of cluster_shape.h, which drops the notes.
ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter, Notes& notes);

/// Adds a note where the spheres reach so far that the lengths of a file may have been millimetres.
void note_size(const std::vector<Sphere>& spheres, const std::string& where, Notes& notes);

} // namespace eccentra::shape

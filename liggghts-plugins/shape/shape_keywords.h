// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the arguments of a command to a shape, and what families of shapes share.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"

#include <string>
#include <vector>

namespace eccentra::shape {

/// Factor of lengths that changes the volume [m3] to that of a sphere of `diameter` [m].
double scale_to_diameter(double volume, double diameter);
/// Multiplies all lengths.
void resize(std::vector<Sphere>& spheres, MassProperties& properties, double scale);

/// The union of these spheres, scaled to the diameter [m] of the sphere of equal volume. Throws std::invalid_argument
/// if the diameter is not above 0.
ClusterShape sized_shape(const std::string& name, std::vector<Sphere> spheres, double diameter);

/// As make_shape of cluster_shape.h, with notes for the user.
ClusterShape make_shape(const std::vector<std::string>& arguments, std::size_t first, std::size_t& used,
                        double diameter, Notes& notes);

/// Adds a note if the body is 0.5 m long or more, because the lengths of its file may be millimetres.
void note_size(const std::vector<Sphere>& spheres, const std::string& where, Notes& notes);

} // namespace eccentra::shape

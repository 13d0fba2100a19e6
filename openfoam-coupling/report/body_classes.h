// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of one kind and size: how many, where, how fast. Pure functions.
#pragma once

#include "report/section_measures.h"

#include <cstddef>
#include <vector>

namespace eccentra::report {

/// Means over the snapshots of a run, weighted by volume within one of them.
struct BodyClass {
  int type = 0;        ///< of atoms
  double slimness = 0; ///< radius of the bounding sphere over that of the sphere of equal volume; 1: a sphere
  double diameter = 0; ///< of the sphere of mean volume [m]
  double count = 0;    ///< mean number of bodies
  double part = 0;     ///< of the volume of all bodies
  double height = 0;   ///< of the centre along `up` from the origin [m]
  double speed = 0;    ///< mean speed [m/s]
  double along = 0;    ///< mean velocity along `flow` [m/s]
  double slow = 0;     ///< part of its volume that is slower than 10 mm/s
};

/// Bodies of equal type, slimness and volume are one class, in the order of these. Of a type and slimness with more
/// than `most` sizes the sizes are divided into `most` ranges of equal ratio. `up` and `flow` are unit vectors. Bodies
/// without a type (Snapshot::type empty) have the type 1, those without a radius the slimness 1.
std::vector<BodyClass> body_classes(const std::vector<Snapshot>& snapshots, const Vector& up, const Vector& flow,
                                    std::size_t most = 8);

} // namespace eccentra::report

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Distance of two convex cores by the algorithm of Gilbert, Johnson and Keerthi (1988).
#pragma once

#include "contact/contact_core.h"

namespace eccentra::contact {

/// Distance of the cores [m], 0 if they overlap; `offset` from A's centre to B's. Insertion uses it, where a pair is
/// examined once; contacts find their points by features.
double gjk_distance(const PosedCore& a, const PosedCore& b, const Eigen::Vector3d& offset);

} // namespace eccentra::contact

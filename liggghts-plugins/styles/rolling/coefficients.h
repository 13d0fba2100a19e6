// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The coefficients that a script gives as fix property/global, checked.
#pragma once

#include <mpi.h>

#include "property_registry.h"

namespace eccentra::styles {

/// mu_r (coefficientRollingFriction) and mu_shape (shapeRollingFriction), per pair of atom types, both >= 0. A missing
/// fix or a value below zero stops all ranks with one sentence.
MatrixProperty* create_rolling_coefficient(PropertyRegistry& registry, const char* caller, bool sanity_checks);
MatrixProperty* create_shape_coefficient(PropertyRegistry& registry, const char* caller, bool sanity_checks);

} // namespace eccentra::styles

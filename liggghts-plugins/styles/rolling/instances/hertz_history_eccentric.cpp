// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles model hertz tangential history rolling_friction eccentric.
#include "styles/entry/style_registry.h"
#include "styles/rolling/register_contact_model.h"

namespace {
const eccentra::styles::RegisterHertzHistory<LIGGGHTS::ContactModels::ROLLING_ECCENTRIC> registered("eccentric");
const eccentra::styles::RegisterKeywords
    eccentric_keywords("rolling_friction", "eccentric",
                       "eq (32), the torque of a shape at the sphere's orientation: shape cube 64");
} // namespace

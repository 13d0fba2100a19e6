// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles model hertz tangential history rolling_friction shape.
#include "styles/entry/style_registry.h"
#include "styles/rolling/register_contact_model.h"

namespace {
const eccentra::styles::RegisterHertzHistory<LIGGGHTS::ContactModels::ROLLING_SHAPE> registered("shape");
const eccentra::styles::RegisterKeywords shape_keywords("rolling_friction", "shape",
                                                        "eq (19) with mu_r + mu_shape: form limited|directional|epsd");
} // namespace

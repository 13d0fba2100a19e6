// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles model hertz tangential history rolling_friction epsd2, which LIGGGHTS runs through slow dispatch.
#include "styles/rolling/register_contact_model.h"

namespace {
const eccentra::styles::RegisterHertzHistory<LIGGGHTS::ContactModels::ROLLING_EPSD2> registered("epsd2");
} // namespace

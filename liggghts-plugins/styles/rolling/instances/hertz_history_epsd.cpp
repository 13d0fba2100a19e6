// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles model hertz tangential history rolling_friction epsd, which LIGGGHTS runs through slow dispatch.
#include "styles/rolling/register_contact_model.h"

namespace {
const eccentra::styles::RegisterHertzHistory<LIGGGHTS::ContactModels::ROLLING_EPSD> registered("epsd");
} // namespace

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles model hertz tangential history rolling_friction luding, which LIGGGHTS runs through slow dispatch.
#include "styles/rolling/register_contact_model.h"

namespace {
const eccentra::styles::RegisterHertzHistory<LIGGGHTS::ContactModels::ROLLING_LUDING> registered("luding");
} // namespace

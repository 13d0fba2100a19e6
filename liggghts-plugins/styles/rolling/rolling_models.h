// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Our rolling models, listed as LIGGGHTS lists its own: each header is read twice, once as a record, once as a class.
// (No include guard: both readings must happen.)
#include "styles/rolling/rolling_model_eccentric.h"
#include "styles/rolling/rolling_model_shape.h"

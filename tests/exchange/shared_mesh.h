// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A program of tests on a small periodic annulus, whole on one rank and cut in two on two. It has this main.
#pragma once

#include "fvMesh.H"

namespace eccentra::test {

/// Made before the tests begin.
extern Foam::fvMesh* sharedMesh;

} // namespace eccentra::test

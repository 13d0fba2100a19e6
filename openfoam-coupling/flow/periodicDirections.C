// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Looks at the areas of periodic patches.
#include "flow/periodicDirections.H"

#include "cyclicAMIPolyPatch.H"
#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"

namespace Foam {

Vector<label> periodicDirections(const fvMesh& mesh) {
  vector separated(Zero);
  for (const polyPatch& patch : mesh.boundaryMesh()) {
    if (isA<cyclicPolyPatch>(patch) || isA<processorCyclicPolyPatch>(patch) || isA<cyclicAMIPolyPatch>(patch)) {
      for (const vector& area : patch.faceAreas()) {
        separated = max(separated, cmptMag(area) / mag(area));
      }
    }
  }
  reduce(separated, maxOp<vector>());
  return Vector<label>(separated.x() > 0.5, separated.y() > 0.5, separated.z() > 0.5);
}

} // namespace Foam

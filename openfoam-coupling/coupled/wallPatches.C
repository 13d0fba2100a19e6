// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Brings the faces of each patch to the master.
#include "coupled/wallPatches.H"

#include "fvMesh.H"
#include "wallPolyPatch.H"

namespace eccentra {

using namespace Foam;

namespace {

/// Flow through a wall, as part of what U is there: round-off.
constexpr scalar kNoFlow = 1e-6;

/// Faces of this rank: number of corners, corners, velocity.
scalarList facesOf(const polyPatch& patch, const vectorField& velocity) {
  DynamicList<scalar> numbers;
  forAll(patch, face) {
    const pointField corners(patch[face].points(patch.points()));
    numbers.append(scalar(corners.size()));
    for (const point& x : corners)
      numbers.append({x.x(), x.y(), x.z()});
    numbers.append({velocity[face].x(), velocity[face].y(), velocity[face].z()});
  }
  return scalarList(std::move(numbers));
}

void append(const scalarList& numbers, std::vector<link::PatchFace>& faces) {
  const auto three = [&numbers](label at) { return link::Vector3{numbers[at], numbers[at + 1], numbers[at + 2]}; };
  for (label at = 0; at < numbers.size();) {
    link::PatchFace& face = faces.emplace_back();
    const label corners = label(numbers[at++]);
    for (label k = 0; k < corners; ++k, at += 3)
      face.corners.push_back(three(at));
    face.velocity = three(at);
    at += 3;
  }
}

} // namespace

std::vector<link::MeshPatch> wallPatches(const volVectorField& U) {
  std::vector<link::MeshPatch> patches;
  for (const fvPatchVectorField& field : U.boundaryField()) {
    const polyPatch& patch = field.patch().patch();
    if (patch.coupled() || polyPatch::constraintType(patch.type()) || returnReduce(patch.size(), sumOp<label>()) == 0)
      continue;
    // A copy tells the velocity of the present time.
    tmp<fvPatchVectorField> present(field.clone(U.internalField()));
    present.ref().evaluate();
    const vectorField& velocity = present();
    const scalar through = gSum(scalarField(mag(velocity & field.patch().Sf())));
    const scalar along = gSum(scalarField(mag(velocity) * field.patch().magSf()));
    link::MeshPatch& mine = patches.emplace_back();
    mine.name = patch.name();
    mine.wall = isA<wallPolyPatch>(patch) || (field.fixesValue() && through <= kNoFlow * along);
    mine.velocity_known = mine.wall && field.fixesValue();
    List<scalarList> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = facesOf(patch, velocity);
    Pstream::gatherList(all);
    if (Pstream::master())
      for (const scalarList& numbers : all)
        append(numbers, mine.faces);
  }
  return patches;
}

} // namespace eccentra

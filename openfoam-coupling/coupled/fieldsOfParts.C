// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Puts the parts of a field together, one field at a time, and takes this rank's out of the whole.
#include "coupled/fieldsOfParts.H"

#include "link/terms.h"

#include "localIOdictionary.H"

namespace eccentra {

using namespace Foam;

namespace {

/// Values of an entry `uniform` or `nonuniform`.
template <class Type> Field<Type> valuesOf(const dictionary& dict, const word& entry, label size) {
  return Field<Type>(entry, dict, size);
}

bool betweenRanks(const word& patchType) {
  return patchType.startsWith("processor");
}

} // namespace

fieldsOfParts::fieldsOfParts(const fvMesh& mesh, const fileNameList& folders, const List<meshPart>& parts)
    : mesh_(mesh), folders_(folders), parts_(parts), mine_(mesh) {
  label stored = 0;
  for (const meshPart& part : parts) {
    stored += part.cells.size();
    for (const label face : part.faces)
      faces_ = max(faces_, mag(face));
    for (const label cell : part.cells)
      cells_ = max(cells_, cell + 1);
  }
  const bool whole =
      stored == cells_ && faces_ > 0 && mine_.cells.size() == mesh.nCells() && mine_.faces.size() == mesh.nFaces();
  label maxCell = -1, maxFace = 0;
  for (const label cell : mine_.cells)
    maxCell = max(maxCell, cell);
  for (const label face : mine_.faces)
    maxFace = max(maxFace, mag(face));
  if (!whole || maxCell >= cells_ || maxFace > faces_ || returnReduce(mesh.nCells(), sumOp<label>()) != cells_)
    throw link::Refusal("the checkpoint was written with another division of the mesh, or of another mesh, and the "
                        "addressing of decomposePar does not lead from one to the other: go on with the case and the "
                        "ranks that wrote it");
}

template <class Type>
fieldsOfParts::Whole<Type> fieldsOfParts::gather(const word& name, const word& type, bool onFaces) const {
  Whole<Type> all;
  all.cells.setSize(onFaces ? 0 : cells_, Zero);
  all.faces.setSize(faces_, Zero);
  all.known.setSize(faces_, false);
  forAll(parts_, rank) {
    const meshPart& part = parts_[rank];
    const localIOdictionary dict(
        IOobject(name, folders_[rank], mesh_.time(), IOobject::MUST_READ, IOobject::NO_WRITE, false), type);
    const auto put = [&](label face, const Type& value) {
      const label whole = mag(part.faces[face]) - 1;
      // A flux is positive out of the owner, which differs for faces that look the other way.
      all.faces[whole] = onFaces && part.faces[face] < 0 ? Type(-value) : value;
      all.known[whole] = true;
    };
    const Field<Type> internal(valuesOf<Type>(dict, "internalField", onFaces ? part.internalFaces : part.cells.size()));
    forAll(internal, i) {
      if (onFaces)
        put(i, internal[i]);
      else
        all.cells[part.cells[i]] = internal[i];
    }
    const dictionary& boundary = dict.subDict("boundaryField");
    forAll(part.patches, patch) {
      const dictionary* const entry = boundary.findDict(part.patches[patch]);
      // Values of cells across a boundary between ranks are those of cells.
      if (!entry || !entry->found("value") || (!onFaces && betweenRanks(entry->get<word>("type"))))
        continue;
      const Field<Type> values(valuesOf<Type>(*entry, "value", part.sizes[patch]));
      forAll(values, i) put(part.starts[patch] + i, values[i]);
    }
  }
  return all;
}

template <class Type>
void fieldsOfParts::read(GeometricField<Type, fvPatchField, volMesh>& field, const word& name) const {
  using VolField = GeometricField<Type, fvPatchField, volMesh>;
  const Whole<Type> whole = gather<Type>(name, VolField::typeName, false);
  VolField fresh(IOobject(name, mesh_.time().timeName(), mesh_, IOobject::NO_READ, IOobject::NO_WRITE, false), field);
  Field<Type>& cells = fresh.primitiveFieldRef();
  forAll(cells, celli) cells[celli] = whole.cells[cellOf(celli)];
  auto& patches = fresh.boundaryFieldRef();
  forAll(patches, patch) {
    fvPatchField<Type>& values = patches[patch];
    if (values.coupled())
      continue;
    // Some conditions write no values: their own (noSlip) or those of the cells (zeroGradient) hold.
    Field<Type> stored(values);
    if (!values.fixesValue())
      stored = values.patchInternalField();
    forAll(stored, i) {
      const label face = faceOf(values.patch().start() + i);
      if (whole.known[face])
        stored[i] = whole.faces[face];
    }
    values == stored;
  }
  const label request = Pstream::nRequests();
  forAll(patches, patch) if (patches[patch].coupled()) patches[patch].initEvaluate(Pstream::commsTypes::nonBlocking);
  Pstream::waitRequests(request);
  forAll(patches, patch) if (patches[patch].coupled()) patches[patch].evaluate(Pstream::commsTypes::nonBlocking);
  field == fresh;
}

void fieldsOfParts::read(surfaceScalarField& flux, const word& name) const {
  const Whole<scalar> whole = gather<scalar>(name, surfaceScalarField::typeName, true);
  surfaceScalarField fresh(IOobject(name, mesh_.time().timeName(), mesh_, IOobject::NO_READ, IOobject::NO_WRITE, false),
                           flux);
  const auto value = [&](label face) {
    return mine_.faces[face] < 0 ? -whole.faces[faceOf(face)] : whole.faces[faceOf(face)];
  };
  scalarField& internal = fresh.primitiveFieldRef();
  forAll(internal, face) internal[face] = value(face);
  auto& patches = fresh.boundaryFieldRef();
  forAll(patches, patch) {
    scalarField values(patches[patch].size());
    forAll(values, i) values[i] = value(patches[patch].patch().start() + i);
    patches[patch] == values;
  }
  flux == fresh;
}

template void fieldsOfParts::read(volScalarField&, const word&) const;
template void fieldsOfParts::read(volVectorField&, const word&) const;

} // namespace eccentra

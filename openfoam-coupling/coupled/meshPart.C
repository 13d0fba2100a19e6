// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what decomposePar has written about a part of the mesh.
#include "coupled/meshPart.H"

#include "IOList.H"

namespace eccentra {

using namespace Foam;

namespace {

labelList addressing(const fvMesh& mesh, const word& name) {
  const IOobject file(name, mesh.facesInstance(), polyMesh::meshSubDir, mesh, IOobject::READ_IF_PRESENT,
                      IOobject::NO_WRITE, false);
  return labelIOList(file, labelList());
}

} // namespace

meshPart::meshPart(const fvMesh& mesh)
    : internalFaces(mesh.nInternalFaces()), patches(mesh.boundaryMesh().names()), starts(mesh.boundaryMesh().size()),
      sizes(mesh.boundaryMesh().size()) {
  if (Pstream::parRun()) {
    cells = addressing(mesh, "cellProcAddressing");
    faces = addressing(mesh, "faceProcAddressing");
  } else {
    cells = identity(mesh.nCells());
    faces = identity(mesh.nFaces(), 1);
  }
  forAll(mesh.boundaryMesh(), patch) {
    starts[patch] = mesh.boundaryMesh()[patch].start();
    sizes[patch] = mesh.boundaryMesh()[patch].size();
  }
}

bool meshPart::operator==(const meshPart& other) const {
  return internalFaces == other.internalFaces && cells == other.cells && faces == other.faces &&
         patches == other.patches && starts == other.starts && sizes == other.sizes;
}

Ostream& operator<<(Ostream& os, const meshPart& part) {
  return os << part.internalFaces << nl << part.cells << nl << part.faces << nl << part.patches << nl << part.starts
            << nl << part.sizes << nl;
}

Istream& operator>>(Istream& is, meshPart& part) {
  return is >> part.internalFaces >> part.cells >> part.faces >> part.patches >> part.starts >> part.sizes;
}

} // namespace eccentra

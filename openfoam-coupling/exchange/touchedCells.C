// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rings grow from block to block by marks on the vertices.
#include "exchange/touchedCells.H"

#include "exchange/coupledVertices.H"

namespace eccentra::exchange {

using namespace Foam;

touchedCells::touchedCells(const fvMesh& mesh)
    : mesh_(mesh), ring_((mesh.nCells() + kBlock - 1) / kBlock, kRings + 1), vertexBegin_{0},
      marked_(mesh.nPoints(), 0), lastVisit_(mesh.nPoints(), 0) {
  coupledVertices(mesh); // made by all ranks together
  std::vector<label> lastBlock(mesh.nPoints(), -1);
  for (label block = 0; block < static_cast<label>(ring_.size()); ++block) {
    for (label cell = block * kBlock; cell < std::min((block + 1) * kBlock, mesh.nCells()); ++cell)
      for (const label vertex : mesh.cellPoints()[cell])
        if (lastBlock[vertex] != block) {
          lastBlock[vertex] = block;
          vertices_.push_back(vertex);
        }
    vertexBegin_.push_back(static_cast<label>(vertices_.size()));
  }
}

void touchedCells::grow() {
  const labelList& coupled = coupledVertices(mesh_);
  std::fill(marked_.begin(), marked_.end(), 0);
  List<label> marks(coupled.size());
  for (int ring = 0; ring < kRings; ++ring) {
    forVertices(ring, [this](label vertex) { marked_[vertex] = 1; });
    forAll(coupled, i) marks[i] = marked_[coupled[i]];
    syncCoupledVertices(mesh_, marks, maxEqOp<label>());
    forAll(coupled, i) marked_[coupled[i]] = static_cast<char>(marks[i]);
    for (std::size_t block = 0; block < ring_.size(); ++block)
      if (ring_[block] > ring &&
          std::any_of(vertices_.begin() + vertexBegin_[block], vertices_.begin() + vertexBegin_[block + 1],
                      [this](label vertex) { return marked_[vertex]; }))
        ring_[block] = ring + 1;
  }
}

} // namespace eccentra::exchange

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through the face planes of convex cells.
#include "exchange/cellWalk.H"

#include "exchange/sharedPatches.H"

#include "cyclicPolyPatch.H"
#include "processorPolyPatch.H"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace eccentra::exchange {

using Foam::label;
using Foam::point;
using Foam::vector;

namespace {

/// A point this far outside a face plane, in units of the cube root of the cell's volume, still belongs to the cell.
constexpr double kPlaneTolerance = 1e-9;
/// Warped faces can make a walk run in circles: after this many cells it ends where it is.
constexpr int kLongestWalk = 10000;
/// Offset of a lane that holds no plane: every point is far behind it [m].
constexpr double kNoPlane = Foam::GREAT;

} // namespace

cellWalk::cellWalk(const Foam::fvMesh& mesh)
    : mesh_(mesh), search_(mesh), patchOfBoundaryFace_(mesh.nFaces() - mesh.nInternalFaces()),
      shared_(sharedPatches(mesh)) {
  const Foam::polyBoundaryMesh& patches = mesh.boundaryMesh();
  forAll(patches, patchi) {
    const Foam::polyPatch& patch = patches[patchi];
    for (label i = 0; i < patch.size(); ++i)
      patchOfBoundaryFace_[patch.start() - mesh.nInternalFaces() + i] = patchi;
    if (Foam::isA<Foam::cyclicPolyPatch>(patch) && !Foam::refCast<const Foam::cyclicPolyPatch>(patch).parallel())
      FatalErrorInFunction << "patch " << patch.name()
                           << " is periodic by rotation, but coupled particles need translations: change the mesh"
                           << Foam::exit(Foam::FatalError);
  }
  // Built here by all ranks together, as their construction may communicate.
  mesh_.cellCentres();
  mesh_.cells();
  for (const double volume : mesh.V().field())
    cellSize_.push_back(std::cbrt(volume));
  for (const double size : cellSize_)
    newBlock(kPlaneTolerance * size);
  for (label cell = 0; cell < mesh.nCells(); ++cell)
    for (const label face : mesh.cells()[cell]) {
      const bool open =
          mesh.isInternalFace(face) || patches[patchOfBoundaryFace_[face - mesh.nInternalFaces()]].coupled();
      if (!open && blocks_[cell].walls < 0) {
        const label walls = newBlock(blocks_[cell].tolerance);
        blocks_[cell].walls = walls;
      }
      addPlane(face, cell, open ? cell : blocks_[cell].walls);
    }
  if (mesh_.nCells() > 0)
    search_.cellTree();
}

label cellWalk::newBlock(double tolerance) {
  PlaneBlock block{};
  std::fill(std::begin(block.offset), std::end(block.offset), kNoPlane);
  block.tolerance = tolerance;
  block.more = block.walls = -1;
  blocks_.push_back(block);
  return static_cast<label>(blocks_.size()) - 1;
}

void cellWalk::addPlane(label face, label cell, label first) {
  label at = first;
  while (blocks_[at].more >= 0)
    at = blocks_[at].more;
  if (blocks_[at].offset[kLanes - 1] != kNoPlane) {
    const label next = newBlock(blocks_[at].tolerance);
    at = blocks_[at].more = next;
  }
  PlaneBlock& block = blocks_[at];
  const auto lane = std::find(std::begin(block.offset), std::end(block.offset), kNoPlane) - std::begin(block.offset);
  const bool own = mesh_.faceOwner()[face] == cell;
  const vector normal((own ? 1 : -1) * mesh_.faceAreas()[face] / Foam::mag(mesh_.faceAreas()[face]));
  for (int k = 0; k < 3; ++k)
    block.normal[k][lane] = normal[k];
  block.offset[lane] = normal & mesh_.faceCentres()[face];
  block.behind[lane] = !mesh_.isInternalFace(face) ? -1 - face
                       : own                       ? mesh_.faceNeighbour()[face]
                                                   : mesh_.faceOwner()[face];
}

label cellWalk::nearestCell(const point& position, double& distanceSqr) const {
  distanceSqr = Foam::GREAT;
  if (mesh_.nCells() == 0)
    return -1;
  const label cell = search_.findNearestCell(position, -1, true);
  if (cell >= 0)
    distanceSqr = Foam::magSqr(mesh_.cellCentres()[cell] - position);
  return cell;
}

WalkEnd cellWalk::walk(Walker& walker) const {
  WalkEnd end;
  for (int step = 0; step < kLongestWalk; ++step) {
    const PlaneBlock& first = blocks_[walker.cell];
    const double x = walker.position[0], y = walker.position[1], z = walker.position[2];
    double distance[kLanes];
    const auto anyBeyond = [&](const PlaneBlock& block, double limit) {
    // Left in one piece, these two loops become vector instructions; unrolled, or for the largest double, they do not.
#pragma GCC unroll 1
      for (int i = 0; i < kLanes; ++i)
        distance[i] = block.normal[0][i] * x + block.normal[1][i] * y + block.normal[2][i] * z - block.offset[i];
      int beyond = 0;
#pragma GCC unroll 1
      for (int i = 0; i < kLanes; ++i)
        beyond |= distance[i] > limit;
      return beyond != 0;
    };
    double deepest = first.tolerance;
    label behind = walker.cell;
    for (label k = walker.cell; k >= 0; k = blocks_[k].more)
      if (anyBeyond(blocks_[k], deepest)) {
        const double* furthest = std::max_element(distance, distance + kLanes);
        deepest = *furthest;
        behind = blocks_[k].behind[furthest - distance];
      }
    if (behind == walker.cell) {
      for (label k = first.walls; k >= 0; k = blocks_[k].more)
        if (anyBeyond(blocks_[k], end.outside))
          end.outside = *std::max_element(distance, distance + kLanes);
      break;
    }
    if (behind >= 0)
      walker.cell = behind;
    else if (!crossPatch(-1 - behind, walker, end))
      return end;
  }
  end.found = true;
  return end;
}

label cellWalk::deepestPatch(const Walker& walker, double& depth) const {
  label deepest = 0;
  depth = -Foam::GREAT;
  for (label k = blocks_[walker.cell].walls; k >= 0; k = blocks_[k].more)
    for (int i = 0; i < kLanes; ++i) {
      double distance = -blocks_[k].offset[i];
      for (int c = 0; c < 3; ++c)
        distance += blocks_[k].normal[c][i] * walker.position[c];
      if (distance > depth) {
        depth = distance;
        deepest = patchOfBoundaryFace_[-1 - blocks_[k].behind[i] - mesh_.nInternalFaces()];
      }
    }
  return deepest;
}

bool cellWalk::holds(const Walker& walker) const {
  return search_.findCell(point(walker.position[0], walker.position[1], walker.position[2]), -1, true) >= 0;
}

bool cellWalk::crossPatch(label meshFace, Walker& walker, WalkEnd& end) const {
  const Foam::vectorField& centres = mesh_.faceCentres();
  const Foam::polyPatch& patch = mesh_.boundaryMesh()[patchOfBoundaryFace_[meshFace - mesh_.nInternalFaces()]];
  const label face = meshFace - patch.start();
  if (Foam::isA<Foam::cyclicPolyPatch>(patch)) {
    const label other = Foam::refCast<const Foam::cyclicPolyPatch>(patch).neighbPatch().start() + face;
    for (int k = 0; k < 3; ++k)
      walker.position[k] += centres[other][k] - centres[meshFace][k];
    walker.cell = mesh_.faceOwner()[other];
    return true;
  }
  end.nextRank = Foam::refCast<const Foam::processorPolyPatch>(patch).neighbProcNo();
  const auto& shared = shared_[end.nextRank];
  end.nextPatch = static_cast<label>(std::find(shared.begin(), shared.end(), patch.index()) - shared.begin());
  end.nextFace = face;
  for (int k = 0; k < 3; ++k)
    walker.position[k] -= centres[meshFace][k];
  return false;
}

WalkEnd cellWalk::enter(Walker& walker, int fromRank, label patch, label face) const {
  const label meshFace = mesh_.boundaryMesh()[shared_[fromRank][patch]].start() + face;
  for (int k = 0; k < 3; ++k)
    walker.position[k] += mesh_.faceCentres()[meshFace][k];
  walker.cell = mesh_.faceOwner()[meshFace];
  return walk(walker);
}

} // namespace eccentra::exchange

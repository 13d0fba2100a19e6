// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through the face planes of convex cells.
#include "cellWalk.H"

#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"
#include "processorPolyPatch.H"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace eccentra::exchange {

using Foam::label;
using Foam::point;
using Foam::vector;

namespace {

/// A point this far outside a face plane, in units of the cube root of the cell's volume, still belongs to the cell.
constexpr double kPlaneTolerance = 1e-9;
/// Warped faces can make a walk run in circles: after this many cells it ends where it is.
constexpr int kLongestWalk = 10000;

} // namespace

cellWalk::cellWalk(const Foam::fvMesh& mesh)
    : mesh_(mesh), search_(mesh), patchOfBoundaryFace_(mesh.nFaces() - mesh.nInternalFaces()),
      shared_(Foam::Pstream::nProcs()) {
  const Foam::polyBoundaryMesh& patches = mesh.boundaryMesh();
  // Two ranks may share one plain and several periodic processor patches; the name of the periodic pair orders them.
  std::vector<std::multimap<std::string, label>> named(shared_.size());
  forAll(patches, patchi) {
    const Foam::polyPatch& patch = patches[patchi];
    for (label i = 0; i < patch.size(); ++i)
      patchOfBoundaryFace_[patch.start() - mesh.nInternalFaces() + i] = patchi;
    if (Foam::isA<Foam::cyclicPolyPatch>(patch) && !Foam::refCast<const Foam::cyclicPolyPatch>(patch).parallel())
      FatalErrorInFunction << "patch " << patch.name()
                           << " is periodic by rotation, but coupled particles need translations: change the mesh"
                           << Foam::exit(Foam::FatalError);
    if (Foam::isA<Foam::processorPolyPatch>(patch)) {
      std::string key;
      if (Foam::isA<Foam::processorCyclicPolyPatch>(patch)) {
        const auto& periodic = Foam::refCast<const Foam::processorCyclicPolyPatch>(patch);
        const auto& referred = Foam::refCast<const Foam::cyclicPolyPatch>(periodic.referPatch());
        key = std::min(referred.name(), referred.neighbPatch().name()) + (referred.owner() ? ":a" : ":b");
        // The two halves of a pair meet each other: the partner of "a" is "b".
        if (Foam::refCast<const Foam::processorPolyPatch>(patch).neighbProcNo() < Foam::Pstream::myProcNo())
          key = std::min(referred.name(), referred.neighbPatch().name()) + (referred.owner() ? ":b" : ":a");
      }
      named[Foam::refCast<const Foam::processorPolyPatch>(patch).neighbProcNo()].emplace(key, patchi);
    }
  }
  for (std::size_t r = 0; r < named.size(); ++r)
    for (const auto& entry : named[r])
      shared_[r].push_back(entry.second);
  // Built here by all ranks together, as their construction may communicate.
  mesh_.cellCentres();
  mesh_.cells();
  normals_.reserve(mesh.nFaces());
  for (const vector& area : mesh.faceAreas())
    normals_.push_back(area / Foam::mag(area));
  for (const double volume : mesh.V().field())
    cellSize_.push_back(std::cbrt(volume));
  if (mesh_.nCells() > 0)
    search_.cellTree();
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
  const Foam::cellList& cells = mesh_.cells();
  const Foam::vectorField& centres = mesh_.faceCentres();
  const Foam::labelList& owner = mesh_.faceOwner();
  const Foam::labelList& neighbour = mesh_.faceNeighbour();
  const Foam::polyBoundaryMesh& patches = mesh_.boundaryMesh();
  point position(walker.position[0], walker.position[1], walker.position[2]);
  label cell = walker.cell;
  WalkEnd end;
  for (int step = 0; step < kLongestWalk && !end.found; ++step) {
    const double tolerance = kPlaneTolerance * cellSize_[cell];
    double deepest = tolerance;
    double behindWall = 0;
    label through = -1;
    for (const label face : cells[cell]) {
      const double sign = owner[face] == cell ? 1 : -1;
      const double distance = sign * ((position - centres[face]) & normals_[face]);
      const bool open =
          mesh_.isInternalFace(face) || patches[patchOfBoundaryFace_[face - mesh_.nInternalFaces()]].coupled();
      if (!open)
        behindWall = std::max(behindWall, distance);
      else if (distance > deepest) {
        deepest = distance;
        through = face;
      }
    }
    if (through < 0) {
      end.found = true;
      end.outside = std::max(0.0, behindWall);
    } else if (mesh_.isInternalFace(through)) {
      cell = owner[through] == cell ? neighbour[through] : owner[through];
    } else {
      const Foam::polyPatch& patch = patches[patchOfBoundaryFace_[through - mesh_.nInternalFaces()]];
      const label face = through - patch.start();
      if (Foam::isA<Foam::cyclicPolyPatch>(patch)) {
        const Foam::cyclicPolyPatch& other = Foam::refCast<const Foam::cyclicPolyPatch>(patch).neighbPatch();
        position += centres[other.start() + face] - centres[through];
        cell = owner[other.start() + face];
      } else {
        end.nextRank = Foam::refCast<const Foam::processorPolyPatch>(patch).neighbProcNo();
        const auto& shared = shared_[end.nextRank];
        end.nextPatch = static_cast<label>(std::find(shared.begin(), shared.end(), patch.index()) - shared.begin());
        end.nextFace = face;
        position -= centres[through];
        break;
      }
    }
  }
  if (end.nextRank < 0)
    end.found = true;
  walker.cell = cell;
  for (int k = 0; k < 3; ++k)
    walker.position[k] = position[k];
  return end;
}

WalkEnd cellWalk::enter(Walker& walker, int fromRank, label patch, label face) const {
  const label meshFace = mesh_.boundaryMesh()[shared_[fromRank][patch]].start() + face;
  for (int k = 0; k < 3; ++k)
    walker.position[k] += mesh_.faceCentres()[meshFace][k];
  walker.cell = mesh_.faceOwner()[meshFace];
  return walk(walker);
}

} // namespace eccentra::exchange

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// annulusMesh: system/annulusMeshDict -> constant/polyMesh and constant/g of an inclined eccentric annulus.
#include "mesh/annulus_grid.h"
#include "support/arithmeticFault.H"
#include "support/commonOptions.H"
#include "support/inputError.H"
#include "support/openfoamFolder.H"

#include "Time.H"
#include "argList.H"
#include "cellModel.H"
#include "cyclicPolyPatch.H"
#include "dimensionedVector.H"
#include "polyMesh.H"
#include "polyMeshTools.H"
#include "primitiveMeshTools.H"
#include "uniformDimensionedFields.H"
#include "unitConversion.H"
#include "wallPolyPatch.H"

#include <sstream>
#include <unistd.h>

using namespace Foam;

namespace {

const scalar standardGravity = 9.81; // m/s2, the value of the reference cases
const scalar largestEccentricity = 0.95;
const label fewestCellsAround = 8;
const double bytesPerCell = 1100;     // at the peak, measured
const unsigned coordinateDigits = 15; // of the points in ASCII: areas of thin cells are differences of these

struct Annulus {
  eccentra::mesh::AnnulusSection section;
  eccentra::mesh::GridOptions options;
  label axialCells;
  scalar length;
  scalar inclination; // degrees from the vertical
  bool periodic;
};

scalar readAbove(const dictionary& dict, const word& keyword, scalar above) {
  const scalar value = dict.get<scalar>(keyword);
  if (!(value > above) || !std::isfinite(value)) {
    throw inputError(dict, keyword, value, "give a number above " + std::to_string(above));
  }
  return value;
}

/// A mesh has some three faces a cell, which OpenFOAM numbers with 32 bits, and lies in the memory of one process.
void refuseTooManyCells(const dictionary& dict, const Vector<label>& cells) {
  const double number = double(cells.x()) * double(cells.y()) * double(cells.z());
  std::ostringstream text;
  if (3 * number + double(cells.x()) * cells.y() + double(cells.y()) * cells.z() > double(labelMax)) {
    text << "these are " << number << " cells, whose faces are more than OpenFOAM can number (" << labelMax
         << "); give fewer cells";
    throw inputError(dict, "cells", cells, text.str());
  }
  const double bytes = bytesPerCell * number;
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > memory) {
    text.precision(3);
    text << "these are " << number << " cells, for which the mesh takes some " << 1e-9 * bytes
         << " GB, and this machine has " << 1e-9 * memory
         << " GB; give fewer cells, or make the mesh on a larger machine";
    throw inputError(dict, "cells", cells, text.str());
  }
}

Annulus readAnnulus(const dictionary& dict) {
  refuseUnknownKeywords(dict, {"holeRadius", "pipeRadius", "eccentricity", "length", "inclination", "cells", "ends",
                               "wallGrading", "wallVertices"});
  Annulus annulus;
  annulus.section.hole_radius = readAbove(dict, "holeRadius", 0);
  annulus.section.pipe_radius = readAbove(dict, "pipeRadius", 0);
  if (annulus.section.pipe_radius >= annulus.section.hole_radius) {
    throw inputError(dict, "pipeRadius", annulus.section.pipe_radius,
                     "the pipe does not fit into the hole; give less than holeRadius " +
                         std::to_string(annulus.section.hole_radius));
  }
  annulus.section.eccentricity = dict.get<scalar>("eccentricity");
  if (!(annulus.section.eccentricity >= 0 && annulus.section.eccentricity <= largestEccentricity)) {
    throw inputError(dict, "eccentricity", annulus.section.eccentricity,
                     "give 0 (concentric) to 0.95; at 1 the pipe touches the hole");
  }
  annulus.length = readAbove(dict, "length", 0);
  annulus.inclination = dict.getOrDefault<scalar>("inclination", 0);
  if (!(annulus.inclination >= 0 && annulus.inclination <= 180)) {
    throw inputError(dict, "inclination", annulus.inclination, "give degrees from the vertical, 0 to 180");
  }
  const Vector<label> cells = dict.get<Vector<label>>("cells");
  if (cells.x() < 1 || cells.y() < fewestCellsAround || cells.z() < 1) {
    throw inputError(dict, "cells", cells, "give (radial around axial), at least (1 8 1)");
  }
  refuseTooManyCells(dict, cells);
  annulus.options.radial = cells.x();
  annulus.options.around = cells.y();
  annulus.axialCells = cells.z();
  annulus.options.wall_grading = dict.found("wallGrading") ? readAbove(dict, "wallGrading", 0) : 1;
  const word vertices = dict.getOrDefault<word>("wallVertices", "equalArea");
  if (vertices != "equalArea" && vertices != "onCircle") {
    throw inputError(dict, "wallVertices", vertices, "give equalArea or onCircle");
  }
  annulus.options.vertices =
      vertices == "onCircle" ? eccentra::mesh::WallVertices::kOnCircle : eccentra::mesh::WallVertices::kEqualArea;
  const word ends = dict.get<word>("ends");
  if (ends != "periodic" && ends != "inletOutlet") {
    throw inputError(dict, "ends", ends, "give periodic or inletOutlet");
  }
  annulus.periodic = ends == "periodic";
  return annulus;
}

/// Numbers points and cells of the structured mesh.
class Numbering {
 public:
  explicit Numbering(const Annulus& annulus)
      : radial_(annulus.options.radial), around_(annulus.options.around), axial_(annulus.axialCells) {}
  label radial() const { return radial_; }
  label around() const { return around_; }
  label axial() const { return axial_; }
  label points() const { return (radial_ + 1) * around_ * (axial_ + 1); }
  label cells() const { return radial_ * around_ * axial_; }
  label point(label i, label j, label k) const { return (k * (radial_ + 1) + i) * around_ + j % around_; }
  label cell(label i, label j, label k) const { return (k * radial_ + i) * around_ + j; }

 private:
  const label radial_, around_, axial_;
};

pointField meshPoints(const Annulus& annulus, const Numbering& number) {
  const auto section = eccentra::mesh::annulus_points(annulus.section, annulus.options);
  pointField points(number.points());
  for (label k = 0; k <= number.axial(); ++k) {
    const scalar z = annulus.length * k / number.axial();
    for (label i = 0; i <= number.radial(); ++i) {
      for (label j = 0; j < number.around(); ++j) {
        const auto& xy = section[i * number.around() + j];
        points[number.point(i, j, k)] = point(xy[0], xy[1], z);
      }
    }
  }
  return points;
}

cellShapeList meshCells(const Numbering& number) {
  const cellModel& hex = cellModel::ref(cellModel::HEX);
  cellShapeList cells(number.cells());
  for (label k = 0; k < number.axial(); ++k) {
    for (label i = 0; i < number.radial(); ++i) {
      for (label j = 0; j < number.around(); ++j) {
        labelList corners(8);
        for (label top = 0; top < 2; ++top) {
          corners[4 * top] = number.point(i, j, k + top);
          corners[4 * top + 1] = number.point(i + 1, j, k + top);
          corners[4 * top + 2] = number.point(i + 1, j + 1, k + top);
          corners[4 * top + 3] = number.point(i, j + 1, k + top);
        }
        cells[number.cell(i, j, k)] = cellShape(hex, corners);
      }
    }
  }
  return cells;
}

face quad(label a, label b, label c, label d) {
  face result(4);
  result[0] = a, result[1] = b, result[2] = c, result[3] = d;
  return result;
}

/// Patches pipe, hole, inlet, outlet. Faces of inlet and outlet correspond one to one, and their points in opposite
/// sense from the same first point, as a cyclic pair wants.
faceListList patchFaces(const Numbering& number) {
  faceListList patches(4);
  patches[0].setSize(number.around() * number.axial());
  patches[1].setSize(number.around() * number.axial());
  patches[2].setSize(number.radial() * number.around());
  patches[3].setSize(number.radial() * number.around());
  label side = 0, end = 0;
  for (label k = 0; k < number.axial(); ++k) {
    for (label j = 0; j < number.around(); ++j) {
      patches[0][side] = quad(number.point(0, j, k), number.point(0, j, k + 1), number.point(0, j + 1, k + 1),
                              number.point(0, j + 1, k));
      const label i = number.radial();
      patches[1][side++] = quad(number.point(i, j, k), number.point(i, j + 1, k), number.point(i, j + 1, k + 1),
                                number.point(i, j, k + 1));
    }
  }
  for (label i = 0; i < number.radial(); ++i) {
    for (label j = 0; j < number.around(); ++j) {
      patches[2][end] = quad(number.point(i, j, 0), number.point(i, j + 1, 0), number.point(i + 1, j + 1, 0),
                             number.point(i + 1, j, 0));
      const label k = number.axial();
      patches[3][end++] = quad(number.point(i, j, k), number.point(i + 1, j, k), number.point(i + 1, j + 1, k),
                               number.point(i, j + 1, k));
    }
  }
  return patches;
}

PtrList<dictionary> patchDictionaries(bool periodic) {
  PtrList<dictionary> patches(4);
  forAll(patches, i) {
    patches.set(i, new dictionary);
    patches[i].set("type", i < 2 ? wallPolyPatch::typeName : periodic ? cyclicPolyPatch::typeName : word("patch"));
  }
  if (periodic) {
    patches[2].set("neighbourPatch", word("outlet"));
    patches[3].set("neighbourPatch", word("inlet"));
  }
  return patches;
}

void report(const polyMesh& mesh, const Annulus& annulus) {
  const scalar exact = annulus.section.area() * annulus.length;
  const scalar volume = sum(mesh.cellVolumes());
  const scalarField orthogonality(polyMeshTools::faceOrthogonality(mesh, mesh.faceAreas(), mesh.cellCentres())());
  const scalarField skewness(
      polyMeshTools::faceSkewness(mesh, mesh.points(), mesh.faceCentres(), mesh.faceAreas(), mesh.cellCentres())());
  const scalar worst = radToDeg(::acos(min(scalar(1), min(orthogonality))));
  Info << "annulusMesh: " << mesh.nCells() << " cells, " << (annulus.periodic ? "periodic" : "inlet to outlet")
       << ", inclination " << annulus.inclination << " deg" << nl << "  volume " << volume << " m3, exact " << exact
       << " m3 (" << 100 * (volume / exact - 1) << " %)" << nl << "  largest non-orthogonality " << worst
       << " deg, skewness " << max(skewness) << nl << "  cell volume " << min(mesh.cellVolumes()) << " to "
       << max(mesh.cellVolumes()) << " m3" << endl;
}

void run(const argList& args) {
  if (!args.checkRootCase()) {
    throw inputError("no case in " + args.path() + ": give its folder with -case, or change into it");
  }
  Time runTime(Time::controlDictName, args);
  const fileName dictPath = args.opt<fileName>("dict", "system/annulusMeshDict");
  const fileName where = dictPath.isAbsolute() ? dictPath : args.path() / dictPath;
  if (!isFile(where)) {
    throw inputError(where + ": no such file: describe the annulus there (see docs/annulusMesh.md)");
  }
  const IOdictionary dict(IOobject(where, runTime, IOobject::MUST_READ, IOobject::NO_WRITE, false));
  const Annulus annulus = readAnnulus(dict);
  const Numbering number(annulus);

  polyMesh mesh(IOobject(polyMesh::defaultRegion, runTime.constant(), runTime), meshPoints(annulus, number),
                meshCells(number), patchFaces(number), wordList({"pipe", "hole", "inlet", "outlet"}),
                patchDictionaries(annulus.periodic), "none", "empty");
  IOstream::defaultPrecision(max(coordinateDigits, IOstream::defaultPrecision()));
  mesh.removeFiles();
  if (!mesh.write()) {
    throw inputError("cannot write " + runTime.path() / "constant/polyMesh" + ": check the folder's permissions");
  }
  const scalar angle = degToRad(annulus.inclination);
  uniformDimensionedVectorField g(
      IOobject("g", runTime.constant(), runTime),
      Foam::dimensionedVector("g", dimAcceleration, standardGravity * vector(0, -::sin(angle), -::cos(angle))));
  g.write();
  report(mesh, annulus);
}

} // namespace

int main(int argc, char* argv[]) {
  eccentra::answerCommonOptions(argc, argv, "annulusMesh");
  eccentra::refuseUnusableCaseFolder(argc, argv);
  argList::addNote(
      "Makes the mesh of an inclined eccentric annulus: system/annulusMeshDict -> constant/polyMesh, constant/g");
  argList::noParallel();
  argList::noBanner();
  argList::addOption("dict", "file", "read this instead of system/annulusMeshDict");
  const argList args(argc, argv);
  eccentra::endOnArithmeticFault("annulusMesh: error: a number that is read is out of range (a division by zero or an "
                                 "overflow): correct it in annulusMeshDict, controlDict or their FoamFile headers\n");
  runReportingErrors("annulusMesh", [&] { run(args); });
  return 0;
}

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// dump cluster/vtk: gathers bodies on the first rank, which draws them from the table of shapes.
#include "styles/bodies/dump_cluster_vtk.h"

#include "base/option_reader.h"
#include "shape/drawn_surface.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "error.h"
#include "update.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

const RegisterDump<DumpClusterVtk>
    record("cluster/vtk", "sub-spheres of clusters and surfaces of rounded bodies as VTK files for ParaView");

/// One body on its way to the first rank, as doubles.
struct Body {
  double tag, type, shape;
  double x[3], v[3], omega[3];
  double orientation[4]; ///< w x y z
  double radius;         ///< of the bounding sphere
};
constexpr int kDoubles = sizeof(Body) / sizeof(double);
/// Strips across an edge of a rounded body: a cube has 444 triangles.
constexpr int kSurfaceSteps = 3;

/// The arrays of a VTK file, filled row by row.
class Rows {
 public:
  Rows() {
    radius_->SetName("radius");
    for (auto* array : {body_.Get(), type_.Get(), shape_.Get()})
      data_->GetPointData()->AddArray(array);
    body_->SetName("body");
    type_->SetName("type");
    shape_->SetName("shape");
    velocity_->SetName("velocity");
    velocity_->SetNumberOfComponents(3);
    omega_->SetName("omega");
    omega_->SetNumberOfComponents(3);
    orientation_->SetName("orientation");
    orientation_->SetNumberOfComponents(4);
    normals_->SetName("Normals");
    normals_->SetNumberOfComponents(3);
    for (auto* array : {radius_.Get(), velocity_.Get(), omega_.Get(), orientation_.Get()})
      data_->GetPointData()->AddArray(array);
  }

  void add(const Body& body, const Eigen::Vector3d& centre, double radius) {
    const vtkIdType point = add_point(body, centre, radius, Eigen::Vector3d::Zero());
    vertices_->InsertNextCell(1, &point);
  }

  /// The surface of a rounded body as triangles, whose corners have the radius 0.
  void add(const Body& body, const Eigen::Vector3d& centre, const Eigen::Quaterniond& turn,
           const shape::TriangleSurface& surface) {
    const vtkIdType first = points_->GetNumberOfPoints();
    for (const shape::SurfacePoint& p : surface.points)
      add_point(body, centre + turn * p.position, 0, turn * p.normal);
    for (const auto& triangle : surface.triangles) {
      const vtkIdType corners[3] = {first + triangle[0], first + triangle[1], first + triangle[2]};
      triangles_->InsertNextCell(3, corners);
    }
  }

  /// The file appears whole or not at all. VTK does not look whether a stream takes what it is given: it fills memory.
  /// Returns why the file could not be written, or nothing.
  std::string write(const std::string& name) {
    data_->SetPoints(points_);
    data_->SetVerts(vertices_);
    if (triangles_->GetNumberOfCells() > 0) {
      data_->SetPolys(triangles_);
      data_->GetPointData()->SetNormals(normals_);
    }
    data_->GetPointData()->SetActiveScalars("radius");
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data_);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone(); // compression would cost more than the rest of the dump
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1)
      return "VTK failed";
    const std::string contents = writer->GetOutputString();
    const std::string unfinished = name + ".part";
    errno = 0;
    std::FILE* const file = std::fopen(unfinished.c_str(), "wb");
    bool done = file && std::fwrite(contents.data(), 1, contents.size(), file) == contents.size();
    done = file && std::fclose(file) == 0 && done;
    if (done && std::rename(unfinished.c_str(), name.c_str()) == 0)
      return "";
    const std::string why = std::strerror(errno);
    std::remove(unfinished.c_str());
    return why;
  }

 private:
  vtkIdType add_point(const Body& body, const Eigen::Vector3d& at, double radius, const Eigen::Vector3d& normal) {
    radius_->InsertNextValue(static_cast<float>(radius));
    body_->InsertNextValue(static_cast<int>(body.tag));
    type_->InsertNextValue(static_cast<int>(body.type));
    shape_->InsertNextValue(static_cast<int>(body.shape));
    velocity_->InsertNextTuple(body.v);
    omega_->InsertNextTuple(body.omega);
    orientation_->InsertNextTuple(body.orientation);
    normals_->InsertNextTuple(normal.data());
    return points_->InsertNextPoint(at.data());
  }

  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> vertices_, triangles_;
  vtkNew<vtkFloatArray> radius_, velocity_, omega_, orientation_, normals_;
  vtkNew<vtkIntArray> body_, type_, shape_;
};

} // namespace

DumpClusterVtk::DumpClusterVtk(LAMMPS* lmp, int narg, char** arg) : Dump(lmp, narg, arg) {
  const std::string where = "dump " + std::string(arg[0]) + " cluster/vtk: ";
  const std::string name = filename;
  const std::string suffix = ".vtp";
  if (name.size() < suffix.size() || name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
    error->all(FLERR, (where + "file name '" + name + "' must end in .vtp, which tells ParaView what it is").c_str());
  if (!multifile || multiproc)
    error->all(FLERR, (where + "file name '" + name +
                       "' must hold one '*' for the time step and no '%': all ranks write "
                       "one file per step")
                          .c_str());
  try {
    base::OptionReader reader({arg + 5, arg + narg});
    while (reader.more()) {
      if (reader.keyword() != "rows")
        reader.unknown("rows spheres|bodies");
      bodies_only_ = reader.choice({"spheres", "bodies"}) == "bodies";
    }
  } catch (const std::invalid_argument& problem) {
    error->all(FLERR, (where + problem.what()).c_str());
  }
}

void DumpClusterVtk::refuse_word(const std::string& text) {
  error->all(FLERR, ("dump_modify " + std::string(id) + ": " + text).c_str());
  std::abort(); // error->all does not return
}

// LIGGGHTS reads these words for dumps of all styles.
void DumpClusterVtk::init_style() {
  if (append_flag)
    refuse_word("append 'yes' is not for dump cluster/vtk, which writes one file per step; expected no: remove it");
  if (format_user)
    refuse_word("format '" + std::string(format_user) +
                "' is not for dump cluster/vtk, whose numbers are binary; expected none: remove it");
}

int DumpClusterVtk::modify_param(int narg, char** arg) {
  const std::string word = arg[0], value = narg > 1 ? arg[1] : "";
  if (word != "sort")
    refuse_word("'" + word +
                "' is not a word of dump cluster/vtk; expected every, first or pad: for some of the bodies, give the "
                "dump a group");
  if (value != "id")
    refuse_word("sort '" + value + "' is not the order of dump cluster/vtk; expected id: remove it");
  return 2;
}

std::string DumpClusterVtk::file_name() const {
  std::string name = filename;
  std::string step = std::to_string(update->ntimestep);
  if (static_cast<int>(step.size()) < padflag)
    step.insert(0, padflag - step.size(), '0');
  return name.replace(name.find('*'), 1, step);
}

std::vector<double> DumpClusterVtk::gather() const {
  FixClusterBodies* bodies = FixClusterBodies::find(lmp);
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit))
      continue;
    Body body{};
    body.tag = atom->tag[i];
    body.type = atom->type[i];
    body.shape = bodies ? bodies->shape_id(i) : FixClusterBodies::plain_sphere;
    std::copy(atom->x[i], atom->x[i] + 3, body.x);
    std::copy(atom->v[i], atom->v[i] + 3, body.v);
    if (atom->omega_flag)
      std::copy(atom->omega[i], atom->omega[i] + 3, body.omega);
    body.orientation[0] = 1.;
    if (bodies)
      std::copy(bodies->quaternion(i), bodies->quaternion(i) + 4, body.orientation);
    body.radius = atom->radius[i];
    double packed[kDoubles];
    std::memcpy(packed, &body, sizeof body);
    mine.insert(mine.end(), packed, packed + kDoubles);
  }
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(nprocs), offsets(nprocs);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  std::vector<double> all(me == 0 ? offsets.back() + counts.back() : 0);
  MPI_Gatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE, 0, world);
  return all;
}

std::string DumpClusterVtk::write_file(const std::vector<double>& rows) const {
  std::vector<Body> sorted(rows.size() / kDoubles);
  if (!sorted.empty())
    std::memcpy(static_cast<void*>(sorted.data()), rows.data(), rows.size() * sizeof(double));
  std::sort(sorted.begin(), sorted.end(), [](const Body& a, const Body& b) { return a.tag < b.tag; });
  FixClusterBodies* bodies = FixClusterBodies::find(lmp);
  Rows out;
  std::map<int, shape::TriangleSurface> surfaces; // of the rounded bodies among the shapes
  for (const Body& body : sorted) {
    const Eigen::Vector3d x(body.x[0], body.x[1], body.x[2]);
    const int shape = static_cast<int>(body.shape);
    if (bodies_only_ || shape == FixClusterBodies::plain_sphere) {
      out.add(body, x, body.radius);
      continue;
    }
    const Eigen::Quaterniond q(body.orientation[0], body.orientation[1], body.orientation[2], body.orientation[3]);
    if (const shape::RoundedHull* hull = bodies->shapes()[shape].hull()) {
      const auto [surface, fresh] = surfaces.try_emplace(shape);
      if (fresh)
        surface->second = shape::drawn_surface(*hull, kSurfaceSteps);
      out.add(body, x, q, surface->second);
      continue;
    }
    for (const shape::Sphere& sphere : bodies->shapes()[shape].spheres())
      out.add(body, x + q * sphere.centre, sphere.radius);
  }
  return out.write(file_name());
}

void DumpClusterVtk::write() {
  const std::vector<double> rows = gather();
  std::string why = me == 0 ? write_file(rows) : "";
  int failed = !why.empty();
  MPI_Bcast(&failed, 1, MPI_INT, 0, world);
  if (failed)
    error->all(FLERR, ("dump " + std::string(id) + " cluster/vtk: file '" + file_name() + "' cannot be written (" +
                       why + "): make its folder or room on the disk")
                          .c_str());
}

} // namespace eccentra::styles

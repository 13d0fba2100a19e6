// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of a case folder: geometry and gravity, the table of the coupled run, particles at the written times.
#pragma once

#include "report/dem_log.h"
#include "report/section_measures.h"

#include <vtkDataArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace eccentra::report {

/// Columns of numbers by name, all of the same length.
struct Table {
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
  std::size_t rows() const { return names.empty() ? 0 : columns.at(names.front()).size(); }
  bool has(const std::string& name) const { return columns.count(name) != 0; }
};

/// Reads comma-separated values under one line of names. An incomplete last line (the run still writes it) is
/// ignored. Throws std::runtime_error with one sentence that names file, line and value if a value is not a number.
Table read_csv(const std::filesystem::path& file);

/// A file of particles: bodies, or the sub-spheres of bodies, as points.
struct ParticleFile {
  std::filesystem::path path;
  long step = 0; ///< the last number in the file's name
};

struct Case {
  std::filesystem::path folder;
  std::string name;
  bool is_annulus = false; ///< of annulusMesh; `section` and `inclination` hold for such cases alone
  Section section;
  double inclination = 0;            ///< degrees from the vertical
  DemRun dem;                        ///< log.liggghts
  Table run;                         ///< postProcessing/eccentra/coupling.csv; empty without a fluid
  std::vector<ParticleFile> bodies;  ///< one point per body: velocity, and mass and density, or the radius of a sphere
  std::vector<ParticleFile> spheres; ///< to draw: sub-spheres if bodies are clusters, else `bodies`
};

/// A case of an annulus has system/annulusMeshDict and coupling.csv. Any other one has log.liggghts, and coupling.csv
/// if it has a fluid. Throws std::runtime_error with one sentence that names the file, the keyword and the remedy.
Case read_case(const std::filesystem::path& folder);

/// One body file as numbers.
Snapshot read_snapshot(const ParticleFile& file);

/// Points of a .vtk or .vtp file; of several blocks, all points together.
vtkSmartPointer<vtkPolyData> read_points(const std::filesystem::path& file);

/// The velocities as dump cluster/vtk or dump custom/vtk name them, or null.
vtkDataArray* velocity_of(vtkPolyData& points);

} // namespace eccentra::report

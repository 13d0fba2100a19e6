// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements flow_fields.h with VTK's reader of OpenFOAM's cases.
#include "report/flow_fields.h"

#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDummyController.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPOpenFOAMReader.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace eccentra::report {
namespace {

namespace fs = std::filesystem;

/// The last time that a folder of fields holds, -1 if it holds none after the start.
double latest_time(const fs::path& folder) {
  double latest = -1;
  for (const auto& item : fs::directory_iterator(folder)) {
    const std::string name = item.path().filename().string();
    char* end = nullptr;
    const double time = std::strtod(name.c_str(), &end);
    if (item.is_directory() && *end == '\0' && time > 0)
      latest = std::max(latest, time);
  }
  return latest;
}

/// VTK's reader of one case.
class Reader {
 public:
  explicit Reader(const fs::path& folder) {
    const std::string control = (folder / "system" / "controlDict").string();
    if (!fs::is_regular_file(control))
      return;
    reader_->SetFileName(control.c_str());
    // Without a controller, which nobody but MPI sets, VTK 9.1 follows a null pointer where a case is in parts.
    reader_->SetController(alone_);
    const fs::path first_part = folder / "processor0";
    const bool parts = fs::is_directory(first_part) && latest_time(first_part) > latest_time(folder);
    reader_->SetCaseType(parts ? vtkPOpenFOAMReader::DECOMPOSED_CASE : vtkPOpenFOAMReader::RECONSTRUCTED_CASE);
    reader_->SkipZeroTimeOff();
    reader_->UpdateInformation();
    vtkInformation& information = *reader_->GetOutputInformation(0);
    if (!information.Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()))
      return;
    const double* first = information.Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    times.assign(first, first + information.Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
    reader_->DisableAllPatchArrays();
    reader_->SetPatchArrayStatus("internalMesh", 1);
    reader_->DisableAllCellArrays();
  }

  std::vector<double> times;

  void choose_velocity_at_points() {
    reader_->SetCellArrayStatus("U", 1);
    reader_->CreateCellToPointOn();
  }

  void choose_all_at_cells() {
    const std::string old_level = "_0";
    for (int i = 0; i < reader_->GetNumberOfCellArrays(); ++i) {
      const std::string name = reader_->GetCellArrayName(i);
      const bool old = name.size() > old_level.size() &&
                       name.compare(name.size() - old_level.size(), old_level.size(), old_level) == 0;
      reader_->SetCellArrayStatus(name.c_str(), old ? 0 : 1);
    }
    reader_->CreateCellToPointOff();
  }

  /// One of `times`; null where the case has no mesh.
  vtkSmartPointer<vtkUnstructuredGrid> read(double time) {
    reader_->UpdateTimeStep(time);
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(reader_->GetOutputDataObject(0));
    if (blocks == nullptr)
      return nullptr;
    const auto together = vtkSmartPointer<vtkAppendFilter>::New();
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      if (auto* grid = vtkUnstructuredGrid::SafeDownCast(iterator->GetCurrentDataObject()))
        together->AddInputData(grid);
    if (together->GetNumberOfInputConnections(0) == 0)
      return nullptr;
    together->Update();
    return together->GetOutput();
  }

 private:
  vtkSmartPointer<vtkDummyController> alone_ = vtkSmartPointer<vtkDummyController>::New();
  vtkSmartPointer<vtkPOpenFOAMReader> reader_ = vtkSmartPointer<vtkPOpenFOAMReader>::New();
};

} // namespace

std::vector<double> flow_times(const fs::path& folder) {
  return Reader(folder).times;
}

vtkSmartPointer<vtkUnstructuredGrid> read_flow(const fs::path& folder, double time) {
  Reader reader(folder);
  if (reader.times.empty())
    return nullptr;
  double chosen = reader.times.back();
  if (time >= 0)
    chosen = *std::min_element(reader.times.begin(), reader.times.end(),
                               [time](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
  reader.choose_velocity_at_points();
  auto grid = reader.read(chosen);
  return grid != nullptr && grid->GetPointData()->HasArray("U") ? grid : nullptr;
}

vtkSmartPointer<vtkUnstructuredGrid> read_all_fields(const fs::path& folder, double time) {
  Reader reader(folder);
  if (reader.times.empty())
    return nullptr;
  reader.choose_all_at_cells();
  return reader.read(time);
}

} // namespace eccentra::report

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of the fluid that a run has written, whole or in parts of processors.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>
#include <vector>

namespace eccentra::report {

/// The times of which there are fields, in ascending order; none without a fluid.
std::vector<double> flow_times(const std::filesystem::path& folder);

/// The mesh with the U written last (point data), or null if the run wrote no time. With `time` >= 0 the one that was
/// written next to it.
vtkSmartPointer<vtkUnstructuredGrid> read_flow(const std::filesystem::path& folder, double time = -1);

/// The mesh with all fields of one of flow_times(), as cell data, or null if there is none. Fields of the old time
/// level (NAME_0) are left out.
vtkSmartPointer<vtkUnstructuredGrid> read_all_fields(const std::filesystem::path& folder, double time);

} // namespace eccentra::report

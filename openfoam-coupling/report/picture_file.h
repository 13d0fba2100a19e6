// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a render window to a PNG file.
#pragma once

#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkWindowToImageFilter.h>

#include <filesystem>
#include <stdexcept>

namespace eccentra::report {

/// Throws std::runtime_error with one sentence if the file cannot be written.
inline void write_png(vtkRenderWindow& window, const std::filesystem::path& file) {
  const auto image = vtkSmartPointer<vtkWindowToImageFilter>::New();
  image->SetInput(&window);
  image->ReadFrontBufferOff();
  const auto writer = vtkSmartPointer<vtkPNGWriter>::New();
  writer->SetFileName(file.c_str());
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw std::runtime_error(file.string() + ": cannot be written: check the folder and the space on the disk");
}

} // namespace eccentra::report

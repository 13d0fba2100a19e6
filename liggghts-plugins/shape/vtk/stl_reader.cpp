// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's reader and vtkCleanPolyData, with checks of what the reader passes over.
#include "shape/vtk/stl_reader.h"

#include "shape/vtk/poly_data.h"

#include <vtkCleanPolyData.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkSTLReader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace eccentra::shape {
namespace {

constexpr std::size_t kHeader = 80, kCount = 4, kFacet = 50; ///< bytes of a binary file

/// Keeps VTK's own messages off the screen while it lives, and the fact that there was one.
class QuietVtk : public vtkCommand {
 public:
  static QuietVtk* New() { return new QuietVtk; } // NOLINT(readability-identifier-naming): VTK's
  void Execute(vtkObject*, unsigned long, void*) override { failed = true; }
  bool failed = false;

 private:
  QuietVtk() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~QuietVtk() override { vtkObject::SetGlobalWarningDisplay(before_); }
  int before_;
};

std::string bytes_of(const std::string& path, const std::string& where) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw std::invalid_argument(where + "is a folder: give the file in it");
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::invalid_argument("cannot read the STL file '" + path + "': check the name and the folder");
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (bytes.empty())
    throw std::invalid_argument(where + "is empty and holds no triangles: write it anew");
  return bytes;
}

/// Number of facets in an ASCII file: its lines "endfacet".
std::size_t ascii_facets(const std::string& bytes) {
  std::string text = bytes;
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  std::size_t count = 0;
  for (std::size_t at = text.find("endfacet"); at != std::string::npos; at = text.find("endfacet", at + 1))
    ++count;
  return count;
}

/// Facets that the file says it holds; refuses what is no STL file and what is cut off.
std::size_t facets_said(const std::string& bytes, const std::string& where) {
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader + kCount)
    std::memcpy(&count, bytes.data() + kHeader, kCount);
  const bool text = bytes.find('\0') == std::string::npos;
  if (bytes.size() >= kHeader + kCount && (!text || bytes.size() == kHeader + kCount + kFacet * std::size_t{count})) {
    const std::size_t there = (bytes.size() - kHeader - kCount) / kFacet;
    if (there != count)
      throw std::invalid_argument(where + (there < count ? "is cut off: " : "is damaged: ") + "its header says " +
                                  std::to_string(count) + " facets, " + std::to_string(there) +
                                  " are there; write or copy it anew");
    return count;
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  std::string word = first == std::string::npos ? "" : bytes.substr(first, 5);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word != "solid")
    throw std::invalid_argument(where + "holds no triangles; expected ASCII STL, which begins with 'solid', or binary "
                                        "STL: export it as one of these");
  if (ascii_facets(bytes) > 0 && bytes.find("endsolid") == std::string::npos &&
      bytes.find("ENDSOLID") == std::string::npos)
    throw std::invalid_argument(where + "is cut off: its 'endsolid' is missing; write or copy it anew");
  return ascii_facets(bytes);
}

} // namespace

Surface read_stl(const std::string& path) {
  const std::string where = "STL file '" + path + "': ";
  const std::size_t said = facets_said(bytes_of(path, where), where);
  if (said == 0)
    throw std::invalid_argument(where + "holds no triangles: export the solid anew");
  vtkNew<QuietVtk> quiet;
  vtkNew<vtkSTLReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, quiet);
  reader->SetFileName(path.c_str());
  reader->MergingOff();
  reader->Update();
  const Surface surface = surface_of(reader->GetOutput());
  for (const Eigen::Vector3d& v : surface.vertices)
    if (!v.allFinite())
      throw std::invalid_argument(where + "has a coordinate that is not a finite number: export the solid anew");
  if (quiet->failed || surface.triangles.size() != said)
    throw std::invalid_argument(where + std::to_string(surface.triangles.size()) + " of its " + std::to_string(said) +
                                " facets can be read: a facet is three lines 'vertex x y z'; export the solid anew");
  return surface;
}

Surface join_vertices(const Surface& surface, double tolerance) {
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(poly_data(surface));
  clean->SetTolerance(tolerance);
  clean->ConvertPolysToLinesOff();
  clean->ConvertLinesToPointsOff();
  clean->Update();
  return surface_of(clean->GetOutput());
}

} // namespace eccentra::shape

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The true surfaces of the bodies of a file, as triangles that need no glyphs.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>

namespace eccentra::report {

/// Surfaces of the points of dump cluster/vtk or of spheres with a radius: spheres, unions of the spheres of a body
/// without what is inside, and the triangles of rounded bodies as they are. The arrays body, id, type, shape, velocity,
/// omega and speed that the points have are those of the surfaces.
class BodySurfaces {
 public:
  /// Spheres are as fine as `most` triangles allow for the bodies of this file, which stands for all of a run.
  BodySurfaces(vtkPolyData& bodies, std::size_t most);
  ~BodySurfaces();
  BodySurfaces(const BodySurfaces&) = delete;
  BodySurfaces& operator=(const BodySurfaces&) = delete;

  /// By the place of its first sphere or corner, which bodies have a surface.
  using Keep = std::function<bool(const std::array<double, 3>&)>;

  vtkSmartPointer<vtkPolyData> of(
      vtkPolyData& bodies, const Keep& keep = [](const std::array<double, 3>&) { return true; });

 private:
  struct Patterns;
  std::unique_ptr<Patterns> patterns_;
};

} // namespace eccentra::report

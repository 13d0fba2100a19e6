// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the families of rounded bodies share: rounding or sphericity, contact radius, size.
#pragma once

#include "base/option_reader.h"
#include "shape/cluster_shape.h"
#include "shape/rounded_hull.h"

#include <functional>
#include <string>

namespace eccentra::shape {

/// A core and the ball that sweeps it.
struct Swept {
  RoundedHull::Core core; ///< in any frame
  double radius;          ///< [m]
};

/// Bodies of one outer form. The rounding, in (0, 1], is the radius of edges and corners over half the smallest outer
/// extent.
struct RoundedForm {
  std::string name; ///< as typed, e.g. "smooth disk aspect 0.3"
  /// The body at a rounding, in units of the outer form.
  std::function<Swept(double rounding)> body;
  bool own_size; ///< has a size without a diameter
};

/// `rounding R` or `sphericity S`, and maybe `contact_radius C`, in any order; 0 is not given.
struct RoundedOptions {
  /// [-], [-] and [m]; 0: not given.
  double rounding = 0, sphericity = 0, contact_radius = 0;
  double scale = 0; ///< of a file
};

/// Reads the options of a form up to the first word that is none of them. Throws std::invalid_argument with one
/// sentence that names the word, its value and the remedy.
RoundedOptions read_rounded_options(base::OptionReader& reader, const std::string& name, bool of_file);

/// `diameter` [m] of the sphere of equal volume; <= 0 keeps the form's own size. Throws std::invalid_argument where
/// there is none, or where no rounding gives the sphericity.
ClusterShape make_rounded(const RoundedForm& form, const RoundedOptions& options, double diameter);

/// A core on a smaller scale, so that the least width of the rounded body is that of this one.
RoundedForm form_of_core(std::string name, const ConvexCore& core);

/// The convex hull of a file, for `hull NAME.stl`; VTK, which reads it, lives apart.
struct HullOfFile {
  ConvexCore core;    ///< of the file
  std::string remark; ///< where the file's body is not convex, or has more vertices than a hull may have
};
/// Reads a file and multiplies its lengths by `scale`. Throws std::invalid_argument.
using HullReader = HullOfFile (*)(const std::string& path, double scale);
/// For all later shapes of this process.
void install_hull_reader(HullReader reader);
/// Null where the program has none.
HullReader hull_reader();

} // namespace eccentra::shape

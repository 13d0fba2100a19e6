// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix particletemplate/cluster: a shape, a size and a density that stock distributions and insertions can use.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/note.h"
#include "shape/size_classes.h"

#include <mpi.h>

#include "fix_template_sphere.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace eccentra::base {
class OptionReader;
}

namespace eccentra::styles {

/// Whose orientation an inserted body gets. `as_inserted`: that of `orientation` of the fix insert/*, and a random one
/// where that keyword is not written.
enum class TemplateOrientation { as_inserted, random, given };

/// Density of the solid [kg/m3]: constant, or drawn for each body.
struct DensityDistribution {
  enum class Kind { constant, uniform, gaussian, lognormal } kind = Kind::constant;
  double middle = 0; ///< the mean; lognormal: the median
  double width = 0;  ///< uniform: half the range; gaussian: the standard deviation; lognormal: that of the logarithm
  static constexpr double kCut = 3; ///< deviations at which bells are cut off
  double mean() const;
  double draw(LAMMPS_NS::RanPark& random) const;
};

/// The arguments of the command: those of stock templates, and ours.
struct TemplateArguments {
  /// All arguments from the id of the fix on. Throws std::invalid_argument.
  explicit TemplateArguments(const std::vector<std::string>& arguments);
  /// Sets the sizes that the text of the file `sieve` states. Throws std::invalid_argument, also without a text.
  void read_sieve(const std::optional<std::string>& text);

  std::vector<std::string> stock;          ///< what FixTemplateSphere reads
  std::vector<std::string> shape_keywords; ///< as make_shape takes them
  double diameter = 0;                     ///< of the sphere of equal volume [m]; 0: as the file says
  std::string sieve;                       ///< file that states the sizes; empty: none
  std::vector<shape::SizeClass> sizes;     ///< with a distribution of diameters; else empty
  DensityDistribution density;
  TemplateOrientation orientation = TemplateOrientation::as_inserted;

 private:
  void read_diameter(base::OptionReader& reader);
  void set_sizes(std::vector<shape::SizeClass> classes);
};

/// Bodies of one size.
struct TemplateSize {
  std::unique_ptr<shape::ClusterShape> shape; ///< until the table takes it
  double below;                               ///< part of the number that is of this or of a smaller size
  double volume;                              ///< [m3]
  double bounding_radius;                     ///< [m]
  int shape_id;                               ///< in the table; -1 before
};

/// Fix style "particletemplate/cluster".
class FixParticletemplateCluster : public LAMMPS_NS::FixTemplateSphere {
 public:
  FixParticletemplateCluster(LAMMPS_NS::LAMMPS* lmp, const TemplateArguments& arguments,
                             std::vector<TemplateSize> sizes);
  ~FixParticletemplateCluster() override;

  // The table of shapes is a fix, and fixes cannot be made while another one is under construction.
  void post_create() override;
  void randomize_single() override;
  void init_ptilist(int count, bool enforce_single, LAMMPS_NS::FixPropertyAtom* release) override;
  void randomize_ptilist(int count, int distribution_groupbit, int distribution_order) override;
  void direct_set_ptlist(int i, const void* data, int distribution_groupbit, int distribution_order) override;

  /// A shape of the distribution of sizes, the same on all ranks; the only one without a distribution.
  int draw_shape() { return size_of(*random_mc).shape_id; }
  double largest_radius() const { return largest_; } ///< of the bounding spheres [m]
  int type() const { return atom_type; }
  /// A density of the distribution [kg/m3], the same on all ranks.
  double draw_density() { return density_.draw(*random_mc); }
  TemplateOrientation orientation() const { return orientation_; }

 private:
  const TemplateSize& size_of(LAMMPS_NS::RanPark& random) const;
  void fill(LAMMPS_NS::ParticleToInsert& particle);

  std::vector<TemplateSize> sizes_;
  double largest_ = 0;
  DensityDistribution density_;
  TemplateOrientation orientation_;
};

} // namespace eccentra::styles

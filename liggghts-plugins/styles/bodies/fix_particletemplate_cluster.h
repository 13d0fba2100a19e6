// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix particletemplate/cluster: a shape, a size and a density that stock distributions and insertions can use.
#pragma once

#include "shape/cluster_shape.h"

#include <mpi.h>

#include "fix_template_sphere.h"

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::styles {

/// Whose orientation an inserted body gets. `as_inserted`: that of `orientation` of the fix insert/*, and a random one
/// where that keyword is not written.
enum class TemplateOrientation { as_inserted, random, given };

/// Density of the solid [kg/m3]: constant, or drawn for each body.
struct DensityDistribution {
  enum class Kind { constant, uniform, gaussian } kind = Kind::constant;
  double mean = 0;
  double width = 0; ///< uniform: half the range; gaussian: the standard deviation, cut off at three of them
  double draw(LAMMPS_NS::RanPark& random) const;
};

/// The arguments of the command: those of stock templates, and ours.
struct TemplateArguments {
  TemplateArguments(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  std::vector<char*> stock;                ///< what FixTemplateSphere reads
  std::vector<std::string> shape_keywords; ///< as make_shape takes them
  double diameter = 0;                     ///< of the sphere of equal volume [m]; 0: as the file says
  DensityDistribution density;
  TemplateOrientation orientation = TemplateOrientation::as_inserted;

 private:
  using Refuse = std::function<void(const std::string&)>;
  int read_density(int narg, char** arg, int at, const Refuse& refuse);
  std::list<std::string> own_; ///< arguments of `stock` that the user did not type
};

/// Fix style "particletemplate/cluster".
class FixParticletemplateCluster : public LAMMPS_NS::FixTemplateSphere {
 public:
  FixParticletemplateCluster(LAMMPS_NS::LAMMPS* lmp, const TemplateArguments& arguments);
  ~FixParticletemplateCluster() override;

  // The table of shapes is a fix, and fixes cannot be made while another one is under construction.
  void post_create() override;
  void randomize_single() override;
  void init_ptilist(int count, bool enforce_single, LAMMPS_NS::FixPropertyAtom* release) override;
  void randomize_ptilist(int count, int distribution_groupbit, int distribution_order) override;
  void direct_set_ptlist(int i, const void* data, int distribution_groupbit, int distribution_order) override;

  int shape_id() const { return shape_id_; }
  double density() const { return density_.mean; } ///< of the solid [kg/m3]
  int type() const { return atom_type; }
  /// A density of the distribution [kg/m3], the same on all ranks.
  double draw_density() { return density_.draw(*random_mc); }
  TemplateOrientation orientation() const { return orientation_; }

 private:
  void fill(LAMMPS_NS::ParticleToInsert& particle);

  std::unique_ptr<shape::ClusterShape> shape_; ///< until the table takes it
  int shape_id_ = -1;
  DensityDistribution density_;
  double volume_ = 0;
  TemplateOrientation orientation_;
};

} // namespace eccentra::styles

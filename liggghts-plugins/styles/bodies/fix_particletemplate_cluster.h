// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix particletemplate/cluster: a shape, a size and a density that stock distributions and insertions can use.
#pragma once

#include "shape/cluster_shape.h"

#include <mpi.h>

#include "fix_template_sphere.h"

#include <memory>
#include <string>
#include <vector>

namespace eccentra::styles {

/// The arguments of the command: those of stock templates, and ours.
struct TemplateArguments {
  TemplateArguments(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  std::vector<char*> stock;                ///< what FixTemplateSphere reads
  std::vector<std::string> shape_keywords; ///< as make_shape takes them
  double diameter = 0;                     ///< of the sphere of equal volume [m]; 0: as the file says
  bool random_orientation = true;
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
  double density() const { return density_; } ///< of the solid [kg/m3]

 private:
  void fill(LAMMPS_NS::ParticleToInsert& particle);

  std::unique_ptr<shape::ClusterShape> shape_; ///< until the table takes it
  int shape_id_ = -1;
  double density_;
  double volume_ = 0;
  bool random_orientation_;
};

} // namespace eccentra::styles

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The list of stock styles that take an atom's radius for its shape, and what to use instead.
#include "styles/bodies/incompatible_styles.h"

#include "styles/bodies/fix_cluster_bodies.h"

#include "compute.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"

#include <cstring>
#include <string>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;

struct Refusal {
  const char* style; ///< exact, or a prefix where it ends in '*'
  const char* remedy;
};

constexpr const char* integrator = "use fix nve/cluster, which moves plain spheres, too";
constexpr Refusal refused_fixes[] = {
    {"nve/sphere", integrator},
    {"nve", integrator},
    {"nve/limit", integrator},
    {"nve/nonspherical", integrator},
    {"nve/superquadric", integrator},
    {"wall/gran", "use fix wall/gran/cluster, which takes the same words and serves plain spheres, too"},
    {"check/timestep/gran", "use fix timestep/limit: the bounding sphere gives a limit that is far too large"},
    {"buoyancy", "use fix fluid/force, whose buoyancy takes the volume of the shape"},
    {"adapt", "a cluster's radius, mass and shape belong together and cannot be changed one by one"},
    {"multisphere*", "choose one of the two ways to carry clusters in one script"},
    {"couple/cfd/force*", "use fix fluid/force and fix fluid/couple"},
};
constexpr Refusal refused_computes[] = {
    {"erotate/sphere*", "use the output f_ID[2] of fix nve/cluster, the energy of rotation"},
    {"contact/atom*", "clusters touch at sub-spheres, which this compute does not see"},
    {"pair/gran/local", "clusters touch at sub-spheres, which this compute does not see"},
    {"wall/gran/local", "clusters touch at sub-spheres, which this compute does not see"},
};

bool matches(const char* style, const char* pattern) {
  const std::size_t length = std::strlen(pattern);
  if (pattern[length - 1] == '*')
    return std::strncmp(style, pattern, length - 1) == 0;
  return std::strcmp(style, pattern) == 0;
}

void refuse(LAMMPS* lmp, const std::string& what, const char* remedy) {
  lmp->error->all(FLERR, (what + " takes a cluster for its bounding sphere: " + remedy).c_str());
}

} // namespace

void refuse_incompatible_styles(LAMMPS* lmp, const FixClusterBodies& bodies) {
  if (bodies.shapes().size() == 0)
    return;
  if (!lmp->force->pair || std::strcmp(lmp->force->pair_style, "gran/cluster") != 0)
    lmp->error->all(FLERR, ("clusters need pair_style gran/cluster, but the pair style is '" +
                            std::string(lmp->force->pair ? lmp->force->pair_style : "none") +
                            "', which would take a cluster for its bounding sphere: write pair_style gran/cluster "
                            "model hertz tangential history rolling_friction off")
                               .c_str());
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    const LAMMPS_NS::Fix* fix = lmp->modify->fix[i];
    for (const Refusal& refused : refused_fixes)
      if (matches(fix->style, refused.style))
        refuse(lmp, "fix " + std::string(fix->id) + " (style " + fix->style + ")", refused.remedy);
  }
  for (int i = 0; i < lmp->modify->ncompute; ++i) {
    const LAMMPS_NS::Compute* compute = lmp->modify->compute[i];
    for (const Refusal& refused : refused_computes)
      if (matches(compute->style, refused.style))
        refuse(lmp, "compute " + std::string(compute->id) + " (style " + compute->style + ")", refused.remedy);
  }
}

} // namespace eccentra::styles

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock's fix insert/pack, insert/rate/region and insert/stream, with what they need to place clusters.
#include "styles/bodies/equal_volume_radii.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/fix_particletemplate_cluster.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_insert_pack.h"
#include "fix_insert_rate_region.h"
#include "fix_insert_stream.h"
#include "force.h"
#include "neigh_list.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

/// Overlaps below this part of the smaller sphere's radius are those of a step's motion, which ghosts lag behind.
constexpr double kWorthAWord = 0.01;

/// Pairs of bodies that overlap, of which one at least has just been placed.
struct NewOverlaps {
  int pairs = 0;
  double deepest = 0; ///< as part of the smaller sphere's radius
  int tags[2] = {0, 0};
};

NewOverlaps find_new_overlaps(LAMMPS& lmp, FixClusterBodies& bodies, int last_old_tag) {
  const Atom& atom = *lmp.atom;
  struct {
    double depth = 0;
    int rank = 0;
  } worst;
  worst.rank = lmp.comm->me;
  NewOverlaps found;
  const NeighList* list = lmp.force->pair ? lmp.force->pair->list : nullptr;
  for (int ii = 0; list && ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    for (int k = 0; k < list->numneigh[i]; ++k) {
      const int j = list->firstneigh[i][k] & NEIGHMASK;
      if (std::max(atom.tag[i], atom.tag[j]) <= last_old_tag || (j >= atom.nlocal && atom.tag[i] > atom.tag[j]))
        continue; // a pair with a ghost stands in both bodies' lists
      const auto placed = [&](int n, std::vector<shape::Sphere>& sphere) -> PlacedBody {
        if (bodies.shape_id(n) != FixClusterBodies::plain_sphere)
          return bodies.insertion().body(bodies.shape_id(n), bodies.quaternion(n));
        sphere = {{Eigen::Vector3d::Zero(), atom.radius[n]}};
        return {&sphere, atom.radius[n], Eigen::Matrix3d::Identity()};
      };
      const Eigen::Vector3d offset(atom.x[j][0] - atom.x[i][0], atom.x[j][1] - atom.x[i][1],
                                   atom.x[j][2] - atom.x[i][2]);
      if (offset.norm() >= atom.radius[i] + atom.radius[j])
        continue;
      std::vector<shape::Sphere> sphere_i, sphere_j;
      const double depth = deepest_overlap(placed(i, sphere_i), placed(j, sphere_j), offset);
      if (depth <= kWorthAWord)
        continue;
      ++found.pairs;
      if (depth > worst.depth) {
        worst.depth = depth;
        found.tags[0] = std::min(atom.tag[i], atom.tag[j]);
        found.tags[1] = std::max(atom.tag[i], atom.tag[j]);
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &found.pairs, 1, MPI_INT, MPI_SUM, lmp.world);
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, lmp.world);
  MPI_Bcast(found.tags, 2, MPI_INT, worst.rank, lmp.world);
  found.deepest = worst.depth;
  return found;
}

/// A stock style of insertion for scenes with clusters: `orientation` reaches their templates, larger bodies that are
/// there already are seen, true volumes count, and overlaps at places where stock does not look are named.
template <class Stock> class InsertWithClusters : public Stock {
 public:
  InsertWithClusters(LAMMPS* lmp, int narg, char** arg) : Stock(lmp, narg, arg) {
    for (int n = 3; n + 1 < narg; ++n) {
      if (!std::strcmp(arg[n], "orientation"))
        orientation_ = std::strcmp(arg[n + 1], "random") ? InsertionOrientation::fixed : InsertionOrientation::random;
      if (!std::strcmp(arg[n], "check_dist_from_subdomain_border"))
        looks_at_borders_ = std::strcmp(arg[n + 1], "no") != 0;
    }
    FixParticledistributionDiscrete& mixture = *this->fix_distribution;
    for (int n = 0; n < mixture.n_particletemplates(); ++n) {
      const auto* cluster = dynamic_cast<FixParticletemplateCluster*>(mixture.particletemplates()[n]);
      if (!cluster)
        continue;
      if (this->compress_flag)
        refuse("compress_tags 'yes' is not possible with clusters: contacts remember bodies by their tags; leave it "
               "out");
      if (orientation_ == InsertionOrientation::fixed && cluster->orientation() == TemplateOrientation::random)
        refuse("orientation is not random, but that of the template '" + std::string(cluster->id) +
               "' is: leave `orientation random` out of the template");
    }
  }

  int setmask() override { return Stock::setmask() | FixConst::PRE_FORCE; }

  void pre_exchange() override {
    FixClusterBodies* bodies = FixClusterBodies::find(this->lmp);
    if (!bodies || this->next_reneighbor != this->update->ntimestep) {
      Stock::pre_exchange();
      return;
    }
    const Atom& atom = *this->atom;
    const int before = this->ninserted;
    last_old_tag_ = atom.nlocal > 0 ? *std::max_element(atom.tag, atom.tag + atom.nlocal) : 0;
    MPI_Allreduce(MPI_IN_PLACE, &last_old_tag_, 1, MPI_INT, MPI_MAX, this->world);
    bodies->insertion().orientation = orientation_;
    Stock::pre_exchange();
    bodies->insertion().orientation = InsertionOrientation::not_written;
    just_placed_ = this->ninserted != before;
  }

  void pre_force(int) override {
    if (!just_placed_)
      return;
    just_placed_ = false;
    FixClusterBodies* bodies = FixClusterBodies::find(this->lmp);
    if (bodies->shapes().size() == 0)
      return;
    const NewOverlaps overlaps = find_new_overlaps(*this->lmp, *bodies, last_old_tag_);
    if (overlaps.pairs == 0)
      return;
    const std::string facts = std::to_string(overlaps.pairs) +
                              " pairs of bodies overlap where bodies have just been "
                              "placed (" +
                              std::to_string(overlaps.tags[0]) + " and " + std::to_string(overlaps.tags[1]) + " by " +
                              std::to_string(static_cast<int>(100 * overlaps.deepest)) +
                              " % of the radius of the smaller sphere)";
    if (!this->check_ol_flag) {
      if (this->comm->me == 0)
        this->error->warning(FLERR, (name() + facts +
                                     ", as overlapcheck is 'no'; expected overlapcheck yes, or places "
                                     "that are free")
                                        .c_str());
    } else if (!looks_at_borders_) {
      refuse(facts +
             ", because check_dist_from_subdomain_border is 'no' and overlaps across the borders of the box and "
             "of the ranks are not seen; expected yes, the default");
    } else {
      refuse(facts + ", which the check of overlaps has not seen; expected a region with more room, or fewer ranks");
    }
  }

 protected:
  // Stock counts what is there by its radius.
  int calc_ninsert_this() override {
    const EqualVolumeRadii true_volumes(this->lmp);
    return Stock::calc_ninsert_this();
  }

  // Stock sizes bins and the region that it looks at by the largest body to insert: larger ones that are there already
  // would not be seen.
  int load_xnear(int number) override {
    const double inserted = this->maxrad;
    const Atom& atom = *this->atom;
    for (int i = 0; i < atom.nlocal + atom.nghost; ++i)
      this->maxrad = std::max(this->maxrad, atom.radius[i]);
    if (this->maxrad == inserted)
      return Stock::load_xnear(number);
    auto& near = this->neighList;
    BoundingBox box = this->getBoundingBox();
    near.reset();
    if (near.setBoundingBox(box, this->maxrad, true, true))
      for (int i = 0; i < atom.nlocal + atom.nghost; ++i)
        if (near.isInBoundingBox(atom.x[i]))
          near.insert(atom.x[i], atom.radius[i]);
    this->maxrad = inserted;
    return static_cast<int>(near.count());
  }

 private:
  std::string name() const { return "fix " + std::string(this->id) + " " + this->style + ": "; }
  void refuse(const std::string& sentence) { this->error->all(FLERR, (name() + sentence).c_str()); }

  InsertionOrientation orientation_ = InsertionOrientation::not_written;
  bool looks_at_borders_ = true;
  bool just_placed_ = false;
  int last_old_tag_ = 0;
};

const RegisterFix<InsertWithClusters<FixInsertPack>> pack("insert/pack", "stock's, for clusters as for spheres");
const RegisterFix<InsertWithClusters<FixInsertRateRegion>> rate("insert/rate/region",
                                                                "stock's, for clusters as for spheres");
const RegisterFix<InsertWithClusters<FixInsertStream>> stream("insert/stream", "stock's, for clusters as for spheres");

} // namespace

} // namespace eccentra::styles

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Command create_bodies: clusters at the places and in the orientations of a list.
#include "base/option_reader.h"
#include "base/refusal.h"
#include "shape/body_list.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/fix_particletemplate_cluster.h"
#include "styles/entry/shared_text.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "lammps.h"
#include "modify.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

/// Overlaps below this part of the smaller sphere's radius are those of places rounded to a few digits.
constexpr double kWorthAWord = 0.01;

/// Finds listed bodies near a place, through periodic sides as well.
class PlaceGrid {
 public:
  PlaceGrid(const Domain& domain, const std::vector<shape::ListedBody>& bodies, double spacing) : domain_(domain) {
    for (int k = 0; k < 3; ++k) {
      const double box = domain.boxhi[k] - domain.boxlo[k];
      count_[k] = std::clamp(static_cast<int>(box / spacing), 1, 1024);
      width_[k] = box / count_[k];
    }
    for (std::size_t n = 0; n < bodies.size(); ++n)
      cells_[cell(bodies[n].place)].push_back(static_cast<int>(n));
  }

  /// Calls visit(number) once for each body that may be within `reach` of x.
  template <class Visit> void for_each_near(const double* x, double reach, Visit visit) const {
    const Cell at = cell(x);
    std::array<std::vector<int>, 3> range;
    for (int k = 0; k < 3; ++k) {
      const int steps = std::min(static_cast<int>(std::ceil(reach / width_[k])), count_[k]);
      for (int d = -steps; d <= steps; ++d) {
        const int c = at[k] + d;
        if (domain_.periodicity[k])
          range[k].push_back(((c % count_[k]) + count_[k]) % count_[k]);
        else if (c >= 0 && c < count_[k])
          range[k].push_back(c);
      }
      std::sort(range[k].begin(), range[k].end());
      range[k].erase(std::unique(range[k].begin(), range[k].end()), range[k].end());
    }
    for (const int i : range[0])
      for (const int j : range[1])
        for (const int k : range[2])
          if (const auto found = cells_.find({i, j, k}); found != cells_.end())
            for (const int n : found->second)
              visit(n);
  }

 private:
  using Cell = std::array<int, 3>;
  Cell cell(const double* x) const {
    Cell c;
    for (int k = 0; k < 3; ++k)
      c[k] = std::clamp(static_cast<int>((x[k] - domain_.boxlo[k]) / width_[k]), 0, count_[k] - 1);
    return c;
  }

  const Domain& domain_;
  int count_[3];
  double width_[3];
  std::map<Cell, std::vector<int>> cells_;
};

class CreateBodies {
 public:
  CreateBodies(LAMMPS* lmp, const std::vector<std::string>& arguments) : lmp_(*lmp) {
    if (!lmp->domain->box_exist)
      base::refuse("there is no simulation box yet; expected create_box before");
    if (lmp->modify->nfix_restart_peratom)
      base::refuse("a restart file has just been read, whose atoms are not complete before the next run; expected `run "
                   "0` before");
    if (lmp->domain->triclinic)
      base::refuse("the box is tilted; expected a box with right angles");
    base::OptionReader reader(arguments);
    file_ = reader.keyword("FILE template ID [overlap refuse|allow]");
    if (const std::string& word = reader.value("template ID, that of a fix particletemplate/cluster");
        word != "template")
      base::refuse("'{}' is not 'template'; expected create_bodies FILE template ID [overlap refuse|allow]", word);
    const std::string& id = reader.value("the id of a fix particletemplate/cluster");
    const int f = lmp->modify->find_fix(id.c_str());
    template_ = f < 0 ? nullptr : dynamic_cast<FixParticletemplateCluster*>(lmp->modify->fix[f]);
    if (!template_)
      base::refuse("template '{}' is not a fix particletemplate/cluster; expected the id of one", id);
    bool allow = false;
    while (reader.more()) {
      if (reader.keyword() != "overlap")
        reader.unknown("overlap refuse, overlap allow");
      allow = reader.choice({"refuse", "allow"}) == "allow";
    }
    read();
    for (std::size_t n = 0; n < listed_.size(); ++n)
      shape_ids_.push_back(template_->draw_shape());
    keep_in_box();
    if (!allow)
      refuse_overlaps();
    create();
  }

 private:
  void read() {
    const std::optional<std::string> text = shared_text(lmp_, file_);
    if (!text)
      base::refuse("file '{}' cannot be read or is empty; expected a list of bodies, one a line", file_);
    std::istringstream in(*text);
    listed_ = shape::read_body_list(in, file_);
  }

  std::string where(const shape::ListedBody& body) const { return file_ + ":" + std::to_string(body.line); }

  void keep_in_box() {
    Domain& domain = *lmp_.domain;
    for (shape::ListedBody& body : listed_) {
      domain.remap(body.place);
      for (int k = 0; k < 3; ++k)
        if (body.place[k] < domain.boxlo[k] || body.place[k] >= domain.boxhi[k])
          base::refuse("{}: the centre ({:f} {:f} {:f}) lies outside of the simulation box; expected a place in it",
                       where(body), body.place[0], body.place[1], body.place[2]);
    }
  }

  PlacedBody placed(std::size_t n) const {
    return FixClusterBodies::require(&lmp_).insertion().body(shape_ids_[n], listed_[n].orientation);
  }

  /// Among the bodies of the list, and with what is there already.
  void refuse_overlaps() {
    Domain& domain = *lmp_.domain;
    FixClusterBodies& bodies = FixClusterBodies::require(&lmp_);
    const double radius = template_->largest_radius();
    const PlaceGrid grid(domain, listed_, 2 * radius);
    const auto apart = [&domain](const double* from, const double* to) {
      Eigen::Vector3d offset(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
      domain.minimum_image(offset.data());
      return offset;
    };
    struct {
      double depth = kWorthAWord;
      int rank = 0;
    } worst;
    worst.rank = lmp_.comm->me;
    int who[2] = {-1, 0}; // of the list; partner's line, or minus its tag
    for (std::size_t n = lmp_.comm->me; n < listed_.size(); n += lmp_.comm->nprocs)
      grid.for_each_near(listed_[n].place, 2 * radius, [&](int m) {
        if (m <= static_cast<int>(n))
          return;
        const double depth =
            deepest_overlap(placed(n), placed(static_cast<std::size_t>(m)), apart(listed_[n].place, listed_[m].place));
        if (depth > worst.depth) {
          worst.depth = depth;
          who[0] = static_cast<int>(n);
          who[1] = listed_[m].line;
        }
      });
    const Atom& atom = *lmp_.atom;
    for (int i = 0; i < atom.nlocal; ++i)
      grid.for_each_near(atom.x[i], radius + atom.radius[i], [&](int m) {
        std::vector<shape::Sphere> sphere = {{Eigen::Vector3d::Zero(), atom.radius[i]}};
        const PlacedBody there = bodies.shape_id(i) != FixClusterBodies::plain_sphere
                                     ? bodies.insertion().body(bodies.shape_id(i), bodies.quaternion(i))
                                     : PlacedBody{&sphere, atom.radius[i], Eigen::Matrix3d::Identity()};
        const double depth =
            deepest_overlap(placed(static_cast<std::size_t>(m)), there, apart(listed_[m].place, atom.x[i]));
        if (depth > worst.depth) {
          worst.depth = depth;
          who[0] = m;
          who[1] = -atom.tag[i];
        }
      });
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, lmp_.world);
    MPI_Bcast(who, 2, MPI_INT, worst.rank, lmp_.world);
    if (worst.depth > kWorthAWord)
      base::refuse(
          "{} and {} {} overlap by {} % of the radius of the smaller sphere; expected places that are free, or "
          "the words `overlap allow`",
          where(listed_[who[0]]), who[1] > 0 ? "line" : "body", std::abs(who[1]), static_cast<int>(100 * worst.depth));
  }

  void create() {
    Atom& atom = *lmp_.atom;
    Modify& modify = *lmp_.modify;
    int last_tag = atom.nlocal > 0 ? *std::max_element(atom.tag, atom.tag + atom.nlocal) : 0;
    MPI_Allreduce(MPI_IN_PLACE, &last_tag, 1, MPI_INT, MPI_MAX, lmp_.world);
    for (std::size_t n = 0; n < listed_.size(); ++n) {
      shape::ListedBody& body = listed_[n];
      const double density = template_->draw_density();
      if (!lmp_.domain->is_in_subdomain(body.place))
        continue;
      atom.avec->create_atom(template_->type(), body.place);
      const int i = atom.nlocal - 1;
      atom.tag[i] = last_tag + 1 + static_cast<int>(n); // in the order of the list on any number of ranks
      atom.mask[i] = 1 | template_->groupbit;
      for (int f = 0; f < modify.nfix; ++f)
        if (modify.fix[f]->create_attribute) {
          modify.fix[f]->pre_set_arrays();
          modify.fix[f]->set_arrays(i);
        }
      std::copy(body.velocity, body.velocity + 3, atom.v[i]);
      std::copy(body.angular_velocity, body.angular_velocity + 3, atom.omega[i]);
      FixClusterBodies::require(&lmp_).make_body(i, shape_ids_[n], density, body.orientation);
    }
    const auto before = atom.natoms;
    bigint local = atom.nlocal;
    MPI_Allreduce(&local, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, lmp_.world);
    if (atom.map_style) {
      atom.nghost = 0;
      atom.map_init();
      atom.map_set();
    }
    const auto created = static_cast<long>(atom.natoms - before);
    if (created != static_cast<long>(listed_.size()))
      base::refuse("only {} of the {} bodies of {} lie in the part of a rank; expected places off the borders between "
                   "ranks",
                   created, listed_.size(), file_);
    if (lmp_.comm->me == 0)
      for (FILE* to : {lmp_.screen, lmp_.logfile})
        if (to)
          std::fprintf(to, "Created %ld bodies from %s\n", created, file_.c_str());
  }

  LAMMPS& lmp_;
  std::string file_;
  FixParticletemplateCluster* template_ = nullptr;
  std::vector<shape::ListedBody> listed_;
  std::vector<int> shape_ids_; ///< of the listed bodies
};

void create_bodies(LAMMPS* lmp, int narg, char** arg) {
  try {
    CreateBodies(lmp, {arg, arg + narg});
  } catch (const std::invalid_argument& problem) {
    lmp->error->all(FLERR, ("create_bodies: " + std::string(problem.what())).c_str());
  }
}

const RegisterCommand registered("create_bodies", "clusters at the places and in the orientations of a list",
                                 create_bodies);

} // namespace

} // namespace eccentra::styles

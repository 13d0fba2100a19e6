// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// compute contact/cluster/local: one row per sub-contact, with the forces that acted in the step.
#include "base/option_reader.h"
#include "styles/bodies/contact_records.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/pair_gran_cluster.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "memory.h"
#include "update.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

using Vector = std::array<double, 3>;

double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector part_along(const double* vector, const double* normal) {
  const double size = dot(vector, normal);
  return {size * normal[0], size * normal[1], size * normal[2]};
}

Vector part_across(const double* vector, const double* normal) {
  const Vector along = part_along(vector, normal);
  return {vector[0] - along[0], vector[1] - along[1], vector[2] - along[2]};
}

/// Area of the circle in which two spheres, or a sphere and a plane, cut each other [m2].
double contact_area(const ContactRecord& c) {
  const double ra = c.radius_a;
  double to_circle = ra - c.overlap; // from A's centre
  if (c.b != ContactRecord::wall) {
    const double distance = ra + c.radius_b - c.overlap;
    to_circle = (distance * distance + ra * ra - c.radius_b * c.radius_b) / (2 * distance);
  }
  return M_PI * std::max(0., ra * ra - to_circle * to_circle);
}

/// A keyword, and the columns that it stands for.
struct Columns {
  const char* keyword;
  int count;
  bool by_default;
  void (*write)(const LAMMPS& lmp, const ContactRecord& c, double* to);
};

void put(const Vector& values, double* to) {
  std::copy(values.begin(), values.end(), to);
}

/// In the order in which they stand in a row, which is that of stock's pair/gran/local. Columns of body 2 are 0 for a
/// wall.
const Columns all_columns[] = {
    {"pos", 6, true,
     [](const LAMMPS& lmp, const ContactRecord& c, double* to) {
       std::copy(lmp.atom->x[c.a], lmp.atom->x[c.a] + 3, to);
       if (c.b != ContactRecord::wall)
         std::copy(lmp.atom->x[c.b], lmp.atom->x[c.b] + 3, to + 3);
     }},
    {"vel", 6, true,
     [](const LAMMPS& lmp, const ContactRecord& c, double* to) {
       std::copy(lmp.atom->v[c.a], lmp.atom->v[c.a] + 3, to);
       if (c.b != ContactRecord::wall)
         std::copy(lmp.atom->v[c.b], lmp.atom->v[c.b] + 3, to + 3);
     }},
    {"id", 3, true,
     [](const LAMMPS& lmp, const ContactRecord& c, double* to) {
       to[0] = lmp.atom->tag[c.a];
       if (c.b == ContactRecord::wall)
         return;
       to[1] = lmp.atom->tag[c.b];
       for (int k = 0; k < 3; ++k) { // the image of a body beyond a periodic side
         const double x = lmp.atom->x[c.b][k];
         if (lmp.domain->periodicity[k] && (x < lmp.domain->boxlo[k] || x >= lmp.domain->boxhi[k]))
           to[2] = 1;
       }
     }},
    {"force", 3, true, [](const LAMMPS&, const ContactRecord& c, double* to) { std::copy(c.force, c.force + 3, to); }},
    {"force_normal", 3, false,
     [](const LAMMPS&, const ContactRecord& c, double* to) { put(part_along(c.force, c.normal), to); }},
    {"force_tangential", 3, false,
     [](const LAMMPS&, const ContactRecord& c, double* to) { put(part_across(c.force, c.normal), to); }},
    {"torque", 3, true,
     [](const LAMMPS&, const ContactRecord& c, double* to) { std::copy(c.torque, c.torque + 3, to); }},
    {"torque_normal", 3, false,
     [](const LAMMPS&, const ContactRecord& c, double* to) { put(part_along(c.torque, c.normal), to); }},
    {"torque_tangential", 3, false,
     [](const LAMMPS&, const ContactRecord& c, double* to) { put(part_across(c.torque, c.normal), to); }},
    {"history", 3, true,
     [](const LAMMPS&, const ContactRecord& c, double* to) { std::copy(c.history, c.history + 3, to); }},
    {"contactArea", 1, true, [](const LAMMPS&, const ContactRecord& c, double* to) { *to = contact_area(c); }},
    {"delta", 1, false, [](const LAMMPS&, const ContactRecord& c, double* to) { *to = c.overlap; }},
    {"contactPoint", 3, false,
     [](const LAMMPS& lmp, const ContactRecord& c, double* to) {
       for (int k = 0; k < 3; ++k)
         to[k] = lmp.atom->x[c.a][k] + c.arm[k];
     }},
    {"sub", 2, false,
     [](const LAMMPS&, const ContactRecord& c, double* to) {
       to[0] = c.sub_a + 1;
       to[1] = c.b == ContactRecord::wall ? 0 : c.sub_b + 1;
     }},
};

} // namespace

/// Local array: a row per sub-contact of this rank, columns as the keywords say. Rows of bodies (default), walls or
/// both.
class ComputeContactClusterLocal : public Compute {
 public:
  ComputeContactClusterLocal(LAMMPS* lmp, int& iarg, int narg, char** arg) : Compute(lmp, iarg, narg, arg) {
    try {
      read_keywords({arg + iarg, arg + narg});
    } catch (const std::invalid_argument& problem) {
      refuse(problem.what());
    }
    iarg = narg;
    const bool any = std::find(typed_.begin(), typed_.end(), true) != typed_.end();
    for (std::size_t k = 0; k < typed_.size(); ++k) {
      typed_[k] = any ? typed_[k] : all_columns[k].by_default;
      width_ += typed_[k] ? all_columns[k].count : 0;
    }
    local_flag = 1;
    size_local_cols = width_;
    size_local_rows = 0;
    timeflag = 1; // outputs announce the steps that they want
  }

  ~ComputeContactClusterLocal() override {
    contact_records(lmp).remove_reader(this);
    memory->destroy(array_);
  }

  void init() override {
    if (!dynamic_cast<PairGranCluster*>(force->pair))
      refuse("reads the contacts of pair_style gran/cluster, not of '" +
             std::string(force->pair ? force->pair_style : "none") +
             "'; expected compute pair/gran/local or wall/gran/local");
    ContactRecords& records = contact_records(lmp);
    records.remove_reader(this);
    records.add_reader(this);
  }

  void compute_local() override {
    invoked_local = update->ntimestep;
    const ContactRecords& records = contact_records(lmp);
    if (!records.holds(update->ntimestep))
      refuse("the contacts of step " + std::to_string(update->ntimestep) +
             " were not written down, as no output announced them; expected dump local, or fix ave/... or thermo "
             "through compute reduce, every so many steps");
    int rows = 0;
    const auto shown = [&](const ContactRecord& c) {
      const int mask = c.b == ContactRecord::wall ? atom->mask[c.a] : atom->mask[c.a] & atom->mask[c.b];
      return (c.b == ContactRecord::wall ? walls_ : bodies_) && (mask & groupbit);
    };
    for (const ContactRecord& c : records.rows)
      rows += shown(c);
    if (rows > room_) {
      room_ = rows + rows / 4;
      memory->destroy(array_);
      memory->create(array_, room_, width_, "contact/cluster/local");
    }
    array_local = array_;
    size_local_rows = rows;
    int row = 0;
    for (const ContactRecord& c : records.rows) {
      if (!shown(c))
        continue;
      double* to = array_[row++];
      std::fill(to, to + width_, 0.);
      for (std::size_t k = 0; k < typed_.size(); ++k)
        if (typed_[k]) {
          all_columns[k].write(*lmp, c, to);
          to += all_columns[k].count;
        }
    }
  }

  double memory_usage() override { return static_cast<double>(room_) * width_ * sizeof(double); }

 private:
  void read_keywords(const std::vector<std::string>& arguments) {
    std::string known = "of";
    for (const Columns& c : all_columns)
      known += std::string(", ") + c.keyword;
    base::OptionReader reader(arguments);
    while (reader.more()) {
      const std::string& word = reader.keyword();
      if (word == "of") {
        const std::string& kind = reader.choice({"bodies", "walls", "all"});
        bodies_ = kind != "walls";
        walls_ = kind != "bodies";
        continue;
      }
      const auto* column = std::find_if(std::begin(all_columns), std::end(all_columns),
                                        [&](const Columns& c) { return word == c.keyword; });
      if (column == std::end(all_columns))
        reader.unknown(known);
      typed_[column - all_columns] = true;
    }
  }

  void refuse(const std::string& sentence) {
    error->all(FLERR, ("compute " + std::string(id) + " contact/cluster/local: " + sentence).c_str());
  }

  std::array<bool, std::size(all_columns)> typed_{};
  bool bodies_ = true, walls_ = false;
  int width_ = 0;
  double** array_ = nullptr;
  int room_ = 0;
};

namespace {
const RegisterCompute<ComputeContactClusterLocal> registered("contact/cluster/local",
                                                             "a row per sub-contact: forces, overlap, place");
}

} // namespace eccentra::styles

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the generators by the classes that own them.
#include "styles/entry/random_states.h"

#include "styles/entry/private_access.h"

#include <mpi.h>

#include "domain.h"
#include "fix_insert.h"
#include "fix_insert_stream.h"
#include "fix_massflow_mesh_sieve.h"
#include "fix_mesh_surface.h"
#include "fix_particledistribution_discrete.h"
#include "fix_template_sphere.h"
#include "lammps.h"
#include "modify.h"
#include "random_park.h"
#include "region.h"
#include "tri_mesh.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <sstream>

namespace {

using namespace LAMMPS_NS;

struct Seed {
  using type = int Random::*;
};
struct Saved {
  using type = int RanPark::*;
};
struct Second {
  using type = double RanPark::*;
};
struct OfRegion {
  using type = RanPark* Region::*;
};
struct OfInsertion {
  using type = RanPark* FixInsert::*;
};
struct SeedOfInsertion {
  using type = int FixInsert::*;
};
struct NumberToInsert {
  using type = int FixInsert::*;
};
struct MassToInsert {
  using type = double FixInsert::*;
};
struct MeasuresShare {
  using type = bool FixInsertStream::*;
};
struct Share {
  using type = double FixInsertStream::*;
};
struct ShortestExtrusion {
  using type = double FixInsertStream::*;
};
struct LongestExtrusion {
  using type = double FixInsertStream::*;
};
struct OfDistribution {
  using type = RanPark* FixParticledistributionDiscrete::*;
};
struct OfTemplate {
  using type = RanPark* FixTemplateSphere::*;
};
struct OfSieve {
  using type = RanPark* FixMassflowMeshSieve::*;
};
struct OfMesh {
  using type = RanPark* MultiNodeMesh<3>::*;
};

} // namespace

namespace eccentra::styles {

template struct PrivateMember<Seed, &Random::seed>;
template struct PrivateMember<Saved, &RanPark::save>;
template struct PrivateMember<Second, &RanPark::second>;
template struct PrivateMember<OfRegion, &Region::random>;
template struct PrivateMember<OfInsertion, &FixInsert::random>;
template struct PrivateMember<SeedOfInsertion, &FixInsert::seed>;
template struct PrivateMember<NumberToInsert, &FixInsert::ninsert>;
template struct PrivateMember<MassToInsert, &FixInsert::massinsert>;
template struct PrivateMember<MeasuresShare, &FixInsertStream::do_ins_fraction_calc>;
template struct PrivateMember<Share, &FixInsertStream::ins_fraction>;
template struct PrivateMember<ShortestExtrusion, &FixInsertStream::extrude_length_min>;
template struct PrivateMember<LongestExtrusion, &FixInsertStream::extrude_length_max>;
template struct PrivateMember<OfDistribution, &FixParticledistributionDiscrete::random>;
template struct PrivateMember<OfTemplate, &FixTemplateSphere::random_insertion>;
template struct PrivateMember<OfSieve, &FixMassflowMeshSieve::random_>;
template struct PrivateMember<OfMesh, &MultiNodeMesh<3>::random_>;

namespace {

using Visit = std::function<void(const std::string& owner, RanPark& generator)>;

template <class Tag, class Owner> void visit_of(Owner* owner, const std::string& name, const Visit& visit) {
  if (owner && owner->*Published<Tag>::pointer)
    visit(name, *(owner->*Published<Tag>::pointer));
}

void for_generators(LAMMPS* lmp, const Visit& visit) {
  for (int i = 0; i < lmp->domain->nregion; ++i)
    visit_of<OfRegion>(lmp->domain->regions[i], std::string("region/") + lmp->domain->regions[i]->id, visit);
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    Fix* const fix = lmp->modify->fix[i];
    const std::string name = std::string("fix/") + fix->id;
    visit_of<OfInsertion>(dynamic_cast<FixInsert*>(fix), name, visit);
    visit_of<OfDistribution>(dynamic_cast<FixParticledistributionDiscrete*>(fix), name, visit);
    visit_of<OfTemplate>(dynamic_cast<FixTemplateSphere*>(fix), name, visit);
    visit_of<OfSieve>(dynamic_cast<FixMassflowMeshSieve*>(fix), name + "/sieve", visit);
    if (auto* const surface = dynamic_cast<FixMeshSurface*>(fix))
      visit_of<OfMesh>(static_cast<MultiNodeMesh<3>*>(surface->triMesh()), name, visit);
  }
}

void for_insertions(LAMMPS* lmp, const std::function<void(FixInsert& insertion)>& visit) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* const insertion = dynamic_cast<FixInsert*>(lmp->modify->fix[i]))
      visit(*insertion);
}

/// What a stream has measured with its generators at its first insertion, on this rank.
std::string share_of(const FixInsertStream& stream) {
  return std::string("share/") + stream.id;
}

std::string seed_of(const FixInsert& insertion) {
  return std::string("seed/") + insertion.id;
}

constexpr const char* kNext = "next/";

std::string next_of(const FixInsert& insertion) {
  return std::string(kNext) + insertion.id;
}

/// It has inserted all that its script asks for: more than before if the script was changed.
bool is_over(FixInsert& insertion) {
  constexpr int kInsertedNumber = 0; // of its vector
  if (insertion.ins_every() == 0)
    return true;
  // The number is known from the script, or from the set-up of a run on.
  const int number = insertion.*Published<NumberToInsert>::pointer;
  const double mass = insertion.*Published<MassToInsert>::pointer;
  const double asked = number > 0 ? number : std::floor(mass / insertion.get_distribution()->mass_expect());
  return insertion.compute_vector(kInsertedNumber) >= asked;
}

/// The lines by their first word.
std::map<std::string, std::string> lines_by_owner(const std::string& states) {
  std::map<std::string, std::string> found;
  std::istringstream lines(states);
  std::string owner, rest;
  while (lines >> owner && std::getline(lines, rest))
    found[owner] = rest;
  return found;
}

} // namespace

std::string random_states(LAMMPS* lmp) {
  std::string states;
  for_generators(lmp, [&](const std::string& owner, RanPark& generator) {
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, " %d %d %.17g\n", generator.*Published<Seed>::pointer,
                  generator.*Published<Saved>::pointer,
                  generator.*Published<Saved>::pointer ? generator.*Published<Second>::pointer : 0.0);
    states += owner + numbers;
  });
  for_insertions(lmp, [&](FixInsert& insertion) {
    states += seed_of(insertion) + ' ' + std::to_string(insertion.*Published<SeedOfInsertion>::pointer) + '\n';
    states += next_of(insertion) + ' ' + std::to_string(insertion.next_reneighbor) + '\n';
    auto* const stream = dynamic_cast<FixInsertStream*>(&insertion);
    if (!stream || stream->*Published<MeasuresShare>::pointer)
      return;
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, " %.17g %.17g %.17g\n", stream->*Published<Share>::pointer,
                  stream->*Published<ShortestExtrusion>::pointer, stream->*Published<LongestExtrusion>::pointer);
    states += share_of(*stream) + numbers;
  });
  return states;
}

std::string next_insertions(const std::string& states) {
  std::string kept;
  for (const auto& [owner, rest] : lines_by_owner(states))
    if (owner.rfind(kNext, 0) == 0)
      kept += owner + rest + '\n';
  return kept;
}

void restore_insertions(LAMMPS* lmp, const std::string& states) {
  const std::map<std::string, std::string> lines = lines_by_owner(states);
  for_insertions(lmp, [&](FixInsert& insertion) {
    const auto seed = lines.find(seed_of(insertion));
    if (seed != lines.end())
      insertion.*Published<SeedOfInsertion>::pointer = std::stoi(seed->second);
    // LIGGGHTS would have an insertion that is over begin again at the next step.
    const auto next = lines.find(next_of(insertion));
    if (next != lines.end() && std::stoll(next->second) <= 0 && is_over(insertion))
      insertion.next_reneighbor = std::stoll(next->second);
  });
}

void restore_random_states(LAMMPS* lmp, const std::string& states) {
  const std::map<std::string, std::string> lines = lines_by_owner(states);
  for_insertions(lmp, [&](FixInsert& insertion) {
    auto* const stream = dynamic_cast<FixInsertStream*>(&insertion);
    const auto line = stream ? lines.find(share_of(*stream)) : lines.end();
    if (line == lines.end())
      return;
    std::istringstream numbers(line->second);
    numbers >> stream->*Published<Share>::pointer >> stream->*Published<ShortestExtrusion>::pointer >>
        stream->*Published<LongestExtrusion>::pointer;
    stream->*Published<MeasuresShare>::pointer = false;
  });
  for_generators(lmp, [&](const std::string& owner, RanPark& generator) {
    const auto line = lines.find(owner);
    if (line == lines.end())
      return;
    std::istringstream numbers(line->second);
    numbers >> generator.*Published<Seed>::pointer >> generator.*Published<Saved>::pointer >>
        generator.*Published<Second>::pointer;
  });
}

} // namespace eccentra::styles

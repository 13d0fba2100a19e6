// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements fix fluid/couple.
#include "styles/fluid/fix_fluid_couple.h"

#include "base/option_reader.h"
#include "base/refusal.h"
#include "link/communication.h"
#include "link/stop_signal.h"
#include "styles/entry/fix_checkpoint.h"
#include "styles/entry/script_replay.h"
#include "styles/entry/style_registry.h"
#include "styles/walls/script_walls.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_gravity.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {
const RegisterFix<FixFluidCouple> registered("fluid/couple",
                                             "exchanges particles and flow with a solver every N steps");

constexpr int kCellHintDoubles = 2;
/// Entries of the vector of stock fix insert/*.
constexpr int kInsertedNumber = 0;
constexpr int kInsertedMass = 1;
constexpr double kLongestWait = 1e6; ///< [s]

using RowsOfThree = const double (*)[3];

/// As Domain::remap, which never comes back from a position that has blown up.
double wrapped(double x, double low, double high) {
  if (x >= low && x < high)
    return x;
  const double inside = x - (high - low) * std::floor((x - low) / (high - low));
  return inside < low || inside >= high ? low : inside;
}
} // namespace

FixFluidCouple::FixFluidCouple(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  try {
    read(std::vector<std::string>(arg + 3, arg + narg));
  } catch (const std::invalid_argument& problem) {
    refuse(problem.what());
  }
  if (igroup != 0)
    refuse("works on all particles: write 'fix " + std::string(id) + " all fluid/couple ...'");
  nevery = 1;
  create_attribute = 1;
  restart_global = 1;
  restart_peratom = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  link::catch_stop_signals("fix fluid/couple");
  connect();
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixFluidCouple::~FixFluidCouple() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

// The fluid side knows from here on that somebody has come, whatever the script does before its first run.
void FixFluidCouple::connect() {
  if (link_ != "socket")
    return;
  try {
    using Rows = link::SocketPeer::Rows;
    own_peer_ = std::make_unique<link::SocketPeer>(world, link::Address(address_, keys_), timeout_,
                                                   rank_connections_ ? Rows::on_rank_connections : Rows::over_root);
    // An error of LIGGGHTS, on whatever rank, is the fluid side's news, too.
    last_words_ = std::make_unique<LastWords>([this](const std::string& arguments) { own_peer_->leave(arguments); });
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
}

void FixFluidCouple::refuse(const std::string& text) {
  if (own_peer_)
    own_peer_->leave(text);
  error->all(FLERR, ("fix fluid/couple '" + std::string(id) + "': " + text).c_str());
  std::abort(); // error->all does not return
}

void FixFluidCouple::read(const std::vector<std::string>& arguments) {
  bool of_socket = false; // keywords that link solver has no use for
  base::OptionReader reader(arguments);
  while (reader.more()) {
    const std::string& keyword = reader.keyword();
    of_socket |= keyword == "keys" || keyword == "timeout" || keyword == "wait";
    if (keyword == "link") {
      link_ = reader.choice({"solver", "socket"});
      if (link_ == "socket")
        address_ = reader.value("the address of the socket");
    } else if (keyword == "every") {
      interval_ = reader.count(1, "DEM steps");
    } else if (keyword == "checkpoint") {
      if (reader.at_number()) {
        checkpoints_ = Checkpoints::counted;
        checkpoint_every_ = reader.count(1, "coupling steps");
      } else {
        const std::string& word = reader.value("auto, off or a number of coupling steps");
        const bool by_clock = word == "auto" || word == "on" || word == "yes";
        if (!by_clock && word != "off" && word != "no" && word != "none")
          base::refuse("keyword 'checkpoint': '{}' is neither a word nor a number that it has; expected auto, off or a "
                       "number of coupling steps",
                       word);
        checkpoints_ = by_clock ? Checkpoints::by_clock : Checkpoints::off;
      }
    } else if (keyword == "overlap") {
      overlap_ = reader.on_off();
    } else if (keyword == "lanes") {
      rank_connections_ = reader.on_off();
    } else if (keyword == "keys") {
      keys_ = reader.value("a folder made by eccentra-keys");
    } else if (keyword == "timeout") {
      timeout_.silence = reader.between(0, kLongestWait, "seconds");
    } else if (keyword == "wait") {
      timeout_.arrival = reader.between(0, kLongestWait, "seconds");
    } else {
      reader.unknown("link, every, checkpoint, keys, timeout, wait, overlap, lanes");
    }
  }
  if (link_.empty())
    base::refuse(
        "keyword 'link' is missing; add link solver (the fluid solver hosts this script) or link socket ADDRESS "
        "(it runs apart)");
  if ((of_socket || !rank_connections_) && link_ != "socket")
    base::refuse("keys, timeout, wait and lanes belong to link socket; drop them");
  if (overlap_ && link_ != "socket")
    base::refuse("keyword 'overlap': 'on' belongs to link socket, because with link solver particles and fluid share "
                 "their ranks, which take turns whatever the order; drop it");
  if (interval_ == 0)
    base::refuse("keyword 'every' is missing; add every N, the DEM steps from one coupling step to the next");
}

int FixFluidCouple::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::END_OF_STEP;
}

// Tickets of all atoms are blank already; LIGGGHTS need not visit them again at the first set-up.
void FixFluidCouple::post_create() {
  just_created = 0;
  FixCheckpoint::add(lmp, 0);
}

void FixFluidCouple::init() {
  forces_ = FixFluidForce::find(lmp);
  if (!forces_)
    refuse("couples a fluid that nothing feels: add fix fluid/force before the run");
  forces_->announce_source(id);
  if (resuming_ && forces_carry_on())
    forces_->carry_on();
  bodies_ = FixClusterBodies::find(lmp);
  if (domain->triclinic)
    refuse("needs a box with right angles: make the simulation box orthogonal");
  if (link_ == "solver") {
    peer_ = link::hosting_solver();
    if (!peer_)
      refuse("link solver needs a fluid solver that hosts this script: start annulusFoam in the case folder instead of "
             "this program");
  } else {
    peer_ = own_peer_.get();
  }
}

link::DemTerms FixFluidCouple::terms() const {
  link::DemTerms terms;
  terms.length_unit = std::strcmp(update->unit_style, "si") == 0 ? 1.0 : 0.0;
  terms.time_step = update->dt;
  terms.interval = interval_;
  terms.particles = atom->natoms;
  for (int k = 0; k < 3; ++k) {
    terms.domain.low[k] = domain->boxlo[k];
    terms.domain.high[k] = domain->boxhi[k];
    terms.domain.periodic[k] = domain->periodicity[k] != 0;
  }
  terms.needed = forces_->needs();
  terms.extents = bodies_ != nullptr;
  terms.overlap = overlap_;
  terms.fluid_density = forces_->rho_f();
  const closures::Rheology& law = forces_->rheology();
  terms.rheology = {law.yield_stress, law.consistency, law.index};
  if (resuming_)
    terms.resumes = mark_;
  for (int i = 0; i < modify->nfix; ++i)
    if (std::strcmp(modify->fix[i]->style, "gravity") == 0)
      static_cast<FixGravity*>(modify->fix[i])->get_gravity(terms.gravity);
  return terms;
}

// Every run of a script states the terms anew: time step and effects may have changed since the last one.
void FixFluidCouple::setup(int) {
  const bigint steps = update->laststep - update->firststep;
  if (steps % interval_ != 0)
    refuse("a run of " + std::to_string(steps) + " steps is not a whole number of intervals of " +
           std::to_string(interval_) + ": change the run's length or every");
  if (resuming_ && update->ntimestep != mark_.step)
    refuse("the checkpoint is one of step " + std::to_string(mark_.step) + " but this run begins at step " +
           std::to_string(update->ntimestep) + ": remove what changes the step between read_restart and the run");
  if (!agreed_ && !resuming_)
    cell_hints_.assign(cell_hints_.size(), link::CellHint{});
  if (!agreed_)
    begin_checkpoints();
  if (resuming_)
    pack();
  try {
    const std::uint64_t layout = peer_->agree(terms()).layout;
    if (layout != layout_)
      cell_hints_.assign(cell_hints_.size(), link::CellHint{});
    layout_ = layout;
    compare_walls(false);
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
  if (!agreed_)
    announce_rank_connections();
  agreed_ = true;
  if (!began_) {
    forces_->reset_reaction();
    couple(0.0);
    began_ = true;
  }
  countdown_ = interval_;
  plan_checkpoint();
  leave_fluid();
}

void FixFluidCouple::compare_walls(bool running) {
  link::WallDescription walls = walls_of_script(lmp, running);
  // Meshes that move belong elsewhere after a while; what stands in the script stays what it is.
  link::WallDescription typed = walls;
  for (link::TriangleWall& mesh : typed.meshes) {
    mesh.corners.clear();
    mesh.velocities.clear();
  }
  link::wire::Bytes arguments = link::wire::encode(typed);
  if (arguments == compared_walls_)
    return;
  walls_move_ = !running && any_moves(walls);
  announce(peer_->compare_walls(walls));
  compared_walls_ = std::move(arguments);
}

void FixFluidCouple::announce_rank_connections() const {
  if (comm->me != 0 || !own_peer_ || own_peer_->why_over_root().empty())
    return;
  for (FILE* out : {screen, logfile})
    if (out)
      std::fprintf(out, "fix fluid/couple '%s': the particles of all ranks travel over rank 0: %s\n", id,
                   own_peer_->why_over_root().c_str());
}

void FixFluidCouple::leave_fluid() {
  left_fluid_at_ = MPI_Wtime();
  counted_before_ = link::communication();
}

void FixFluidCouple::pre_initial_integrate() {
  if (resuming_) {
    resuming_ = false;
    mark_ = {};
  }
  if (overlap_ && !ahead_)
    begin_interval();
  if (countdown_ == 1) {
    look_for_signals();
    sort_with_neighbours();
  }
}

void FixFluidCouple::begin_interval() {
  try {
    peer_->advance();
  } catch (const link::Refusal& refusal) {
    keep_particles();
    refuse(refusal.what());
  }
  ahead_ = true;
}

void FixFluidCouple::end_of_step() {
  if (--countdown_ > 0)
    return;
  countdown_ = interval_;
  const int stop_before = stop_;
  couple(interval_ * update->dt);
  if (walls_move_) {
    try {
      compare_walls(true);
    } catch (const link::Refusal& refusal) {
      refuse(refusal.what());
    }
  }
  forces_->reset_reaction();
  ++coupling_steps_;
  if (due_ || stop_before)
    write_checkpoint();
  if (stop_before)
    stop_for_signal();
  plan_checkpoint();
}

void FixFluidCouple::post_run() {
  if (!agreed_)
    return;
  if (comm->me == 0)
    for (FILE* out : {screen, logfile})
      if (out)
        std::fputs(load_.table().c_str(), out);
  load_ = {};
  try {
    peer_->run_ended();
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
}

void FixFluidCouple::pack() {
  const int count = atom->nlocal;
  if (overlap_)
    std::swap(earlier_, before_);
  std::swap(before_, packed_);
  packed_.tags.assign(atom->tag, atom->tag + count);
  packed_.position.resize(3 * std::size_t(count));
  volume_.resize(count);
  extent_.resize(bodies_ ? link::kExtentDoubles * std::size_t(count) : 0);
  for (int i = 0; i < count; ++i) {
    double* x = packed_.position.data() + 3 * std::size_t(i);
    std::copy_n(atom->x[i], 3, x);
    // Between neighbour rebuilds LIGGGHTS lets positions run out of a periodic box.
    for (int k = 0; k < 3; ++k)
      if (domain->periodicity[k])
        x[k] = wrapped(x[k], domain->boxlo[k], domain->boxhi[k]);
    volume_[i] = forces_->particle_volume(i);
    if (bodies_)
      pack_extent(i, extent_.data() + link::kExtentDoubles * std::size_t(i));
  }
}

// Six points at +-e_k with a sixth of the volume each have the second moment M_kk = V |e_k|^2 / 3 about axis k.
void FixFluidCouple::pack_extent(int i, double* extent) {
  using Row = Eigen::Map<Eigen::Vector3d>;
  const int shape = bodies_->shape_id(i);
  if (shape < 0) {
    // A ball's second moment is V R^2 / 5.
    const double radius = 0.5 * forces_->equivalent_diameter(i);
    Eigen::Map<Eigen::Matrix3d>(extent, 3, 3) = std::sqrt(3.0 / 5.0) * radius * Eigen::Matrix3d::Identity();
    return;
  }
  const double* q = bodies_->quaternion(i);
  const Eigen::Matrix3d axes = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  const Eigen::Vector3d inertia = bodies_->shapes()[shape].inertia_per_mass();
  for (int k = 0; k < 3; ++k) {
    // Moments of inertia are sums of second moments: I_k = M_i + M_j.
    const double moment = 0.5 * inertia.sum() - inertia[k];
    Row(extent + 3 * k) = std::sqrt(3.0 * std::max(moment, 0.0)) * axes.col(k);
  }
}

void FixFluidCouple::add_totals(double computed, const link::Communication& between,
                                link::CouplingStep& coupling_step) const {
  link::DemTotals& sums = coupling_step.totals;
  const link::FluidReaction reaction = forces_->reaction();
  enum {
    kVolume,
    kMass,
    kImpulse,
    kMomentum = kImpulse + 3,
    kPosition = kMomentum + 3,
    kVelocitySum = kPosition + 3,
    kParticles = kVelocitySum + 3,
    kComputed,
    kWaited,
    kMessages,
    kOperations,
    kBytes,
    kCount
  };
  double mine[kCount] = {};
  mine[kParticles] = atom->nlocal;
  mine[kComputed] = computed;
  mine[kWaited] = between.waited;
  mine[kMessages] = between.messages;
  mine[kOperations] = between.operations;
  mine[kBytes] = between.bytes;
  enum { kFastest, kMostParticles, kMostComputed, kMaxima };
  double most[kMaxima] = {0, double(atom->nlocal), computed};
  double& fastest = most[kFastest];
  for (int i = 0; i < atom->nlocal; ++i) {
    mine[kVolume] += volume_[i];
    mine[kMass] += atom->rmass[i];
    double speed = 0;
    for (int k = 0; k < 3; ++k) {
      mine[kImpulse + k] += reaction.impulse[i][k];
      mine[kMomentum + k] += atom->rmass[i] * atom->v[i][k] + 0.5 * update->dt * atom->f[i][k];
      mine[kPosition + k] += volume_[i] * packed_.position[3 * std::size_t(i) + k];
      mine[kVelocitySum + k] += volume_[i] * atom->v[i][k];
      speed += atom->v[i][k] * atom->v[i][k];
    }
    fastest = std::max(fastest, speed);
  }
  double all[kCount];
  MPI_Allreduce(mine, all, kCount, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, most, kMaxima, MPI_DOUBLE, MPI_MAX, world);
  sums.fastest = std::sqrt(fastest);
  coupling_step.load.ranks = comm->nprocs;
  coupling_step.load.max_particles = std::llround(most[kMostParticles]);
  coupling_step.load.mean_seconds = all[kComputed] / comm->nprocs;
  coupling_step.load.max_seconds = most[kMostComputed];
  const auto mean = [&](int k) { return all[k] / comm->nprocs; };
  coupling_step.load.between = {mean(kWaited), mean(kMessages), mean(kOperations), mean(kBytes)};
  sums.particles = std::llround(all[kParticles]);
  for (int i = 0; i < modify->nfix; ++i) {
    Fix* const fix = modify->fix[i];
    if (std::strncmp(fix->style, "insert/", std::strlen("insert/")) != 0)
      continue;
    sums.inserted += std::llround(fix->compute_vector(kInsertedNumber));
    sums.inserted_mass += fix->compute_vector(kInsertedMass);
  }
  sums.volume = all[kVolume];
  sums.mass = all[kMass];
  std::copy_n(all + kImpulse, 3, sums.impulse);
  std::copy_n(all + kMomentum, 3, sums.momentum);
  std::copy_n(all + kPosition, 3, sums.volume_position);
  std::copy_n(all + kVelocitySum, 3, sums.volume_velocity);
}

void FixFluidCouple::couple(double elapsed) {
  const double arrived = MPI_Wtime();
  const link::Communication between = link::communication() - counted_before_;
  const double computed = elapsed > 0 ? std::max(0.0, arrived - left_fluid_at_ - between.waited) : 0.0;
  link::CouplingStep coupling_step;
  coupling_step.needed = forces_->needs();
  coupling_step.elapsed = elapsed;
  coupling_step.dem_seconds = elapsed > 0 ? arrived - left_fluid_at_ : 0.0;
  coupling_step.pack_seconds = pack_seconds_;
  coupling_step.steps_done = update->ntimestep - update->firststep;
  coupling_step.steps_total = update->laststep - update->firststep;
  pack();
  add_totals(computed, between, coupling_step);
  load_.add(coupling_step);
  const link::FluidReaction reaction = forces_->reaction();
  link::ParticleArrays particles;
  particles.count = atom->nlocal;
  particles.position = reinterpret_cast<RowsOfThree>(packed_.position.data());
  particles.volume = volume_.data();
  particles.impulse = reaction.impulse;
  particles.drag_coefficient = reaction.drag_coefficient;
  if (bodies_)
    particles.extent = reinterpret_cast<const double(*)[link::kExtentDoubles]>(extent_.data());
  particles.cell_hint = cell_hints_.data();
  pack_seconds_ = MPI_Wtime() - arrived;
  const std::string departed = departures(coupling_step.totals);
  try {
    const link::StepAnswer answer = peer_->couple(coupling_step, particles, forces_->samples());
    if (stop_ == 0)
      stop_ = answer.stop_signal;
    announce(answer.news);
  } catch (const link::Refusal& refusal) {
    keep_particles();
    const std::string why = with_ids(refusal.what());
    const std::string who = why.find(link::kVolumeChanged) == std::string::npos ? "" : changes();
    refuse(who.empty() ? why : who + ": " + why);
  }
  if (!departed.empty()) {
    announce(departed + "; later ones are counted only (columns left and outside of coupling.csv)");
    told_of_departure_ = true;
  }
  ahead_ = false;
  leave_fluid();
}

void FixFluidCouple::grow_arrays(int rows) {
  cell_hints_.resize(rows);
}

void FixFluidCouple::copy_arrays(int from, int to, int) {
  cell_hints_[to] = cell_hints_[from];
}

void FixFluidCouple::set_arrays(int i) {
  cell_hints_[i] = link::CellHint{};
}

int FixFluidCouple::pack_exchange(int i, double* buffer) {
  buffer[0] = cell_hints_[i].rank;
  buffer[1] = cell_hints_[i].cell;
  return kCellHintDoubles;
}

int FixFluidCouple::unpack_exchange(int row, double* buffer) {
  cell_hints_[row] = {static_cast<std::int32_t>(buffer[0]), static_cast<std::int32_t>(buffer[1])};
  return kCellHintDoubles;
}

double FixFluidCouple::memory_usage() {
  double bytes = double(cell_hints_.capacity() * sizeof(link::CellHint)) +
                 double((volume_.capacity() + extent_.capacity()) * sizeof(double));
  for (const PackedParticles* packed : {&packed_, &before_, &earlier_})
    bytes += double(packed->tags.capacity() * sizeof(int) + packed->position.capacity() * sizeof(double));
  return bytes;
}

} // namespace eccentra::styles

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The meeting of particles and fluid, on the fluid's side.
#include "coupledRun.H"

#include "demHost.h"
#include "fluidCheckpoint.H"
#include "inputError.H"
#include "meanOverParts.H"
#include "statedTerms.H"

#include "link/fluid_server.h"
#include "link/stop_signal.h"

#include "OSspecific.H"
#include "Time.H"
#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"

#include <mpi.h>

#include <cfenv>
#include <chrono>
#include <cmath>
#include <exception>

namespace eccentra {

using namespace Foam;

namespace {

constexpr unsigned kOffered =
    fluid::kVelocity | fluid::kFraction | fluid::kPressureGradient | fluid::kStressDivergence | fluid::kVorticity;
/// Defaults of lengths, in mean particle diameters.
constexpr double kDiffusionDiameters = 3.0;
constexpr double kGaussianDiameters = 1.0;
/// One implicit step leaves a cusp that a particle feels while it crosses cells.
constexpr label kDiffusionSteps = 2;
/// Meetings from one report to the next.
constexpr label kReportEvery = 10;
constexpr double kMegabyte = 1e6;

/// A quantity that the particles may ask for.
struct Asked {
  unsigned bit;
  const char* name;
  int doubles;
};
constexpr Asked kQuantities[] = {{fluid::kVelocity, "velocity", 3},
                                 {fluid::kFraction, "fraction", 1},
                                 {fluid::kPressureGradient, "pressureGradient", 3},
                                 {fluid::kStressDivergence, "stressDivergence", 3},
                                 {fluid::kVorticity, "vorticity", 3}};

/// Bytes of one particle's samples.
std::size_t bytesToParticles(unsigned needed) {
  std::size_t doubles = 0;
  for (const Asked& quantity : kQuantities)
    doubles += needed & quantity.bit ? quantity.doubles : 0;
  return doubles * sizeof(double);
}

/// Bytes of one particle on its way to the fluid: position, volume, impulse, drag coefficient, extent.
std::size_t bytesToFluid(const link::DemTerms& dem) {
  return (3 + 1 + 3 + 1 + (dem.extents ? link::kExtentDoubles : 0)) * sizeof(double);
}

class stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Keeps the host's messages away while it lives.
class quiet {
 public:
  explicit quiet(bool verbose) : level_(messageStream::level) {
    if (!verbose)
      messageStream::level = 0;
  }
  ~quiet() { messageStream::level = level_; }

 private:
  const int level_;
};

/// Which floating-point exceptions end the process while it lives. OpenFOAM asks for some of them; loops of the DEM
/// side, vectorised, may divide by zero where nobody looks at the result.
class trapping {
 public:
  explicit trapping(int exceptions) : before_(fegetexcept()) { set(exceptions); }
  trapping(const trapping&) = delete;
  trapping& operator=(const trapping&) = delete;
  ~trapping() { set(before_); }

 private:
  static void set(int exceptions) {
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(exceptions);
  }
  const int before_;
};

/// LIGGGHTS needs MPI, which OpenFOAM starts in parallel runs only.
class runningMpi {
 public:
  runningMpi() {
    int running = 0;
    MPI_Initialized(&running);
    if (running)
      return;
    // Libraries below MPI may trip over trapped floating-point exceptions while they start.
    std::fenv_t trapping;
    std::feholdexcept(&trapping);
    MPI_Init(nullptr, nullptr);
    std::feclearexcept(FE_ALL_EXCEPT);
    std::fesetenv(&trapping);
    ours_ = true;
  }
  // OpenFOAM ends what it has not begun only with a warning.
  ~runningMpi() {
    if (ours_ && std::uncaught_exceptions() == 0)
      MPI_Finalize();
  }

 private:
  bool ours_ = false;
};

IOobject propertiesFile(const Time& time) {
  return IOobject("couplingProperties", time.constant(), time, IOobject::MUST_READ, IOobject::NO_WRITE);
}

bool readMomentum(const dictionary& properties) {
  const word momentum(properties.getOrDefault<word>("momentum", "semiImplicit"));
  if (momentum != "semiImplicit" && momentum != "explicit")
    throw inputError(properties, "momentum", momentum, "use semiImplicit or explicit");
  return momentum == "semiImplicit";
}

exchange::VoidFraction readVoidFraction(const dictionary& properties) {
  const word method(properties.getOrDefault<word>("voidFraction", "diffusion"));
  try {
    return exchange::voidFractionOf(method);
  } catch (const std::invalid_argument& problem) {
    throw inputError(properties.name() + ": " + problem.what());
  }
}

/// Bounding box of the mesh, and the directions in which plane periodic patches repeat it.
link::Extents extentsOf(const fvMesh& mesh) {
  link::Extents extents;
  const boundBox box(mesh.points(), true);
  for (direction k = 0; k < 3; ++k) {
    extents.low[k] = box.min()[k];
    extents.high[k] = box.max()[k];
  }
  vector separated(Zero);
  for (const polyPatch& patch : mesh.boundaryMesh())
    if (isA<cyclicPolyPatch>(patch) || isA<processorCyclicPolyPatch>(patch))
      for (const vector& area : patch.faceAreas())
        separated = max(separated, cmptMag(area) / mag(area));
  reduce(separated, maxOp<vector>());
  for (direction k = 0; k < 3; ++k)
    extents.periodic[k] = separated[k] > 0.5;
  return extents;
}

} // namespace

coupledRun::coupledRun(fvMesh& mesh, bool verbose, bool resume)
    : mesh_(mesh), time_(const_cast<Time&>(mesh.time())), properties_(propertiesFile(mesh.time())), verbose_(verbose),
      resume_(resume), traps_(fegetexcept()), semiImplicit_(readMomentum(properties_)),
      method_(readVoidFraction(properties_)), timeStep_(time_), interval_(time_.controlDict().get<scalar>("deltaT")) {}

bool coupledRun::wanted(const Time& time) {
  return isFile(time.globalPath() / time.constant() / "couplingProperties");
}

void coupledRun::run() {
  refuseUnknownKeywords(properties_, {"link", "demScript", "demLog", "voidFraction", "length", "diffusionSteps",
                                      "momentum", "mostSolid", "fractionFloor", "tolerance", "report", "runIn",
                                      "address", "keys", "timeout", "wait"});
  const word link(properties_.getOrDefault<word>("link", "solver"));
  if (link != "solver" && link != "socket")
    throw inputError(properties_, "link", link, "use solver or socket");
  const label every = properties_.getOrDefault<label>("report", kReportEvery);
  if (every < 1)
    throw inputError(properties_, "report", every, "give a whole number of meetings, at least 1");
  const runningMpi mpi;
  link::catch_stop_signals("annulusFoam");
  link::end_on_arithmetic_fault("annulusFoam");
  if (link == "solver")
    hostScript();
  else
    serveSocket();
  time_.writeNow();
}

void coupledRun::hostScript() {
  const fileName script(properties_.get<fileName>("demScript"));
  // The script's own paths are relative to the case.
  if (!chDir(time_.globalPath()))
    throw inputError("cannot enter the case folder " + time_.globalPath());
  if (!isFile(script))
    throw inputError(properties_, "demScript", script, "give a LIGGGHTS input script in the case folder");
  link::hosting_solver() = this;
  const trapping off(0);
  run_dem_script(script, properties_.getOrDefault<fileName>("demLog", "log.liggghts"),
                 resume_ ? link::script_variables(newestCheckpoint()) : std::vector<std::string>());
  link::hosting_solver() = nullptr;
  if (!flow_)
    throw inputError(properties_, "demScript", script, "it never ran a fix fluid/couple with link solver: add one");
}

void coupledRun::serveSocket() {
  const fileName address(properties_.get<fileName>("address"));
  link::Patience patience;
  patience.silence = properties_.getOrDefault<scalar>("timeout", patience.silence);
  patience.arrival = properties_.getOrDefault<scalar>("wait", patience.arrival);
  // A relative Unix path is relative to the case.
  if (!chDir(time_.globalPath()))
    throw inputError("cannot enter the case folder " + time_.globalPath());
  try {
    link::FluidServer server(MPI_COMM_WORLD, {address, properties_.getOrDefault<fileName>("keys", "")}, patience,
                             mesh_.nCells());
    Info << "waiting for a DEM script with fix fluid/couple link socket " << address << endl;
    server.serve(*this);
  } catch (const link::Refusal&) {
    // What the flow has reached is kept.
    if (exchange_)
      time_.writeNow();
    throw;
  }
  if (!flow_)
    throw inputError(properties_, "address", address, "the DEM script that came there never ran its fix fluid/couple");
}

link::CheckpointChoice coupledRun::newestCheckpoint() const {
  const auto fluidPart = [this](const link::Manifest& dem, std::string& why) {
    return fluidCheckpoint::whole(mesh_, dem.mark, why);
  };
  const link::CheckpointChoice choice = link::newest_checkpoint(fluidPart);
  for (const std::string& sentence : choice.passed_over)
    Info << sentence << endl;
  Info << (choice.mark.step < 0 ? "no complete checkpoint: the run begins at its beginning"
                                : "the run goes on from checkpoint " + std::to_string(choice.mark.step))
       << endl;
  return choice;
}

void coupledRun::resumeFrom(const link::CheckpointMark& mark) {
  std::string why;
  if (!fluidCheckpoint::whole(mesh_, mark, why))
    throw link::Refusal("the DEM side goes on from checkpoint " + std::to_string(mark.step) +
                        " but the fluid cannot: " + why + "; take another checkpoint for both, or begin anew");
  const dictionary facts = fluidCheckpoint::facts(mesh_, mark.step);
  // A folder of that time may have told another step, in fewer digits; only a step makes it the last one.
  time_.setDeltaT(facts.get<scalar>("lastStep"), false);
  ++time_;
  time_.setTime(facts.get<scalar>("time"), facts.get<label>("timeIndex"));
  time_.setDeltaT(facts.get<scalar>("lastStep"), false);
  exchange::ExchangeSettings settings;
  settings.length = facts.get<scalar>("length");
  settings.diffusionSteps = facts.get<label>("diffusionSteps");
  makeExchange(settings);
  fluidCheckpoint::readFields(*flow_, *exchange_, mark.step);
  flow_->resume(facts.get<scalar>("drive"));
  asked_ = unsigned(facts.get<label>("asked"));
  const dictionary report = facts.subDict("report");
  report_ =
      std::make_unique<couplingReport>(mesh_, dem_, properties_.getOrDefault<label>("report", kReportEvery), &report);
}

std::string coupledRun::checkpoint(const link::CheckpointMark& mark) {
  const trapping on(traps_);
  dictionary facts;
  facts.add("time", time_.value());
  facts.add("timeIndex", time_.timeIndex());
  facts.add("lastStep", time_.deltaTValue());
  facts.add("length", exchange_->settings().length);
  facts.add("diffusionSteps", label(exchange_->settings().diffusionSteps));
  facts.add("drive", flow_->drive().G());
  facts.add("asked", label(asked_));
  facts.add("report", report_->state());
  return fluidCheckpoint::write(*flow_, *exchange_, mark, facts);
}

link::FluidTerms coupledRun::agree(const link::DemTerms& dem) {
  const trapping on(traps_);
  // A checkpoint brings fields of its own: the flow is made from those of the beginning, not from a folder of a later
  // time that a full disk may have left in pieces.
  if (!flow_)
    fluidCheckpoint::begin(time_, resume_ || dem.resumes.step >= 0);
  if (!flow_)
    flow_ = std::make_unique<averagedFlow>(mesh_, averagedFlow::particles::coupled);
  link::FluidTerms terms;
  terms.time_step = interval_;
  terms.domain = extentsOf(mesh_);
  terms.offered = kOffered;
  terms.fluid_density = flow_->rho();
  terms.rheology = statedRheology(flow_->rheology(), flow_->rho());
  stateGravity(mesh_, terms);
  terms.layout = fluidCheckpoint::layoutOf(mesh_);
  const std::string text = link::disagreement(dem, terms);
  if (!text.empty())
    throw link::Refusal(text);
  dem_ = dem;
  if (dem.resumes.step >= 0)
    resumeFrom(dem.resumes);
  return terms;
}

void coupledRun::makeExchange(const link::Meeting& meeting) {
  exchange::ExchangeSettings settings;
  const double diameter =
      meeting.totals.particles
          ? std::cbrt(6.0 / constant::mathematical::pi * meeting.totals.volume / meeting.totals.particles)
          : 0.0;
  const double diameters = method_ == exchange::VoidFraction::gaussian ? kGaussianDiameters : kDiffusionDiameters;
  settings.length = properties_.getOrDefault<scalar>("length", diameters * diameter);
  if (!(settings.length > 0) &&
      (method_ == exchange::VoidFraction::diffusion || method_ == exchange::VoidFraction::gaussian))
    throw inputError(properties_, "length", settings.length,
                     "give the length of spreading in metres (three particle diameters), as the scene starts empty");
  settings.diffusionSteps = properties_.getOrDefault<label>("diffusionSteps", kDiffusionSteps);
  makeExchange(settings);
}

void coupledRun::makeExchange(exchange::ExchangeSettings settings) {
  settings.method = method_;
  settings.mostSolid = properties_.getOrDefault<scalar>("mostSolid", settings.mostSolid);
  settings.fractionFloor = properties_.getOrDefault<scalar>("fractionFloor", settings.fractionFloor);
  settings.tolerance = properties_.getOrDefault<scalar>("tolerance", settings.tolerance);
  try {
    exchange_ = std::make_unique<exchange::particleExchange>(mesh_, settings);
  } catch (const std::invalid_argument& problem) {
    throw inputError(properties_.name() + ": " + problem.what());
  }
}

// The fluid alone, with long steps, until it flows: the particles then start in a developed flow.
void coupledRun::runIn() {
  const dictionary* dict = properties_.findDict("runIn");
  if (!dict || time_.value() > SMALL)
    return;
  const label steps = dict->get<label>("steps");
  const scalar step = dict->get<scalar>("deltaT");
  if (steps < 0 || !(step > 0))
    throw inputError(*dict, "deltaT", step, "give a positive time step, and steps from 0 on");
  const scalar start = time_.value();
  const label index = time_.timeIndex();
  const scalar usual = time_.deltaTValue();
  time_.setDeltaT(step, false);
  const quiet silence(verbose_);
  for (label i = 0; i < steps; ++i) {
    ++time_;
    flow_->advance();
  }
  time_.setDeltaT(usual, false);
  time_.setTime(start, index);
  messageStream::level = std::max(messageStream::level, 1);
  Info << "run-in of the fluid: " << steps << " steps of " << step << " s, dp/dz " << flow_->drivingPressureGradient()
       << " Pa/m" << endl;
}

// Particles that the drag makes follow the fluid within one interval move the fluid again in the next one, the other
// way round: u_new = -r (3/2 u - 1/2 u_old) with r = s (1 - alpha)/alpha, s the part of the slip that drag takes away
// in an interval, and the second-order time scheme. In a dense bed in a thick fluid that grows. If the fluid learns
// only the share theta = 1.5/(1 + 2.5 r) of the new fraction, it halves at each meeting; where r < 0.2 it learns all.
scalar coupledRun::shareOfNewFraction(const link::Meeting& meeting, const scalarField& solid,
                                      const scalarField* drag) const {
  const scalar density = meeting.totals.volume > 0 ? meeting.totals.mass / meeting.totals.volume : 1.0;
  scalar most = 0;
  forAll(solid, cell) {
    if (solid[cell] < SMALL)
      continue;
    const scalar follows =
        drag ? -std::expm1(-std::min((*drag)[cell] * meeting.elapsed / (solid[cell] * density), scalar(50))) : 1.0;
    most = std::max(most, follows * solid[cell] / (1.0 - solid[cell]));
  }
  reduce(most, maxOp<scalar>());
  return std::min(1.0, 1.5 / (1.0 + 2.5 * most));
}

void coupledRun::checkFinite(const link::Meeting& meeting) const {
  const link::DemTotals& totals = meeting.totals;
  double sum = totals.fastest;
  for (int k = 0; k < 3; ++k)
    sum += totals.momentum[k] + totals.volume_position[k];
  const bool particles = std::isfinite(sum);
  if (particles && std::isfinite(mag(flow_->superficialVelocity())))
    return;
  throw link::Refusal("the coupled run has blown up at t = " + time_.timeName() + " s: the " +
                      (particles ? "fluid's velocity" : "particles' motion") +
                      " is no number; reduce deltaT and the DEM time step together, or every, and go on from the last "
                      "checkpoint with -resume");
}

int coupledRun::meet(const link::Meeting& meeting, const link::ParticleArrays& particles,
                     const fluid::FluidSamples& samples) {
  checkFinite(meeting);
  const trapping on(traps_);
  const bool first = !exchange_;
  if (first) {
    makeExchange(meeting);
    runIn();
    report_ = std::make_unique<couplingReport>(mesh_, dem_, properties_.getOrDefault<label>("report", kReportEvery));
  }
  follow(meeting);
  stopwatch watch;
  PartSeconds seconds;
  seconds.dem = meeting.dem_seconds;
  seconds.link = meeting.pack_seconds;
  const bool advances = meeting.elapsed > 0;
  const scalarField before(flow_->alpha().primitiveField());
  scalar left = advances ? timeStep_.partOf(interval_, flow_->CourantNo()) : 0;
  if (advances)
    ++time_;

  scalarField solid, drag;
  vectorField force;
  exchange_->deposit(particles, meeting.elapsed, solid, &force, semiImplicit_ ? &drag : nullptr);
  const bool start = first && time_.value() <= SMALL;
  const scalar share = start ? 1.0 : shareOfNewFraction(meeting, solid, semiImplicit_ ? &drag : nullptr);
  const scalarField after(share < 1 ? scalarField(before + share * (1.0 - solid - before)) : scalarField(1.0 - solid));
  const auto setFraction = [&](scalar part) {
    flow_->alpha().primitiveFieldRef() = part < 1 ? scalarField(before + part * (after - before)) : after;
    flow_->alpha().correctBoundaryConditions();
  };
  setFraction(1 - left / interval_);
  flow_->particleForce().primitiveFieldRef() = force / flow_->rho();
  flow_->particleForce().correctBoundaryConditions();
  if (semiImplicit_) {
    flow_->exchange().primitiveFieldRef() = drag / flow_->rho();
    flow_->exchange().correctBoundaryConditions();
  }
  if (start)
    flow_->resetFractionHistory();
  seconds.exchange = watch.lap();

  bool due = false;
  meanOverParts pressureMean, stressMean;
  while (advances) {
    const quiet silence(verbose_);
    flow_->advance();
    due = due || time_.writeTime();
    if (!(left > 0))
      break;
    if (samples.pressure_gradient)
      pressureMean.add(flow_->pressureGradient(), flow_->alpha(), time_.deltaTValue() / interval_);
    if (samples.stress_divergence)
      stressMean.add(flow_->stressDivergence(), flow_->alpha(), time_.deltaTValue() / interval_);
    left = timeStep_.partOf(left, flow_->CourantNo());
    ++time_;
    setFraction(1 - left / interval_);
  }
  seconds.fluid = watch.lap();
  checkFinite(meeting);

  exchange::FlowFields fields;
  fields.velocity = &flow_->U();
  fields.fraction = &flow_->alpha();
  tmp<volVectorField> pressure, stress;
  if (samples.pressure_gradient) {
    pressure = flow_->pressureGradient();
    pressureMean.complete(pressure.ref(), flow_->alpha(), time_.deltaTValue() / interval_);
    fields.pressureGradient = &pressure().primitiveField();
  }
  if (samples.stress_divergence) {
    stress = flow_->stressDivergence();
    stressMean.complete(stress.ref(), flow_->alpha(), time_.deltaTValue() / interval_);
    fields.stressDivergence = &stress().primitiveField();
  }
  exchange_->sample(fields, particles, samples);
  seconds.exchange += watch.lap();
  report_->add(*flow_, *exchange_, meeting, seconds);
  if (due)
    time_.writeNow();
  return returnReduce(label(link::stop_signal()), maxOp<label>());
}

void coupledRun::run_ended() {
  if (!report_)
    return;
  report_->finish();
  printCounters();
}

// The screen of fix fluid/force may drop quantities, and ask for them again.
void coupledRun::follow(const link::Meeting& meeting) {
  // Over the time that has passed, particles received V div tau if they were told it at its beginning.
  flow_->setStressShare(asked_ & fluid::kStressDivergence ? averagedFlow::stressShare::fraction
                                                          : averagedFlow::stressShare::full);
  if (meeting.needed != asked_ || counters_.meetings == 0)
    printRequest(meeting);
  asked_ = meeting.needed;
  ++counters_.meetings;
  counters_.pressureGradients += (asked_ & fluid::kPressureGradient) != 0;
  counters_.stressDivergences += (asked_ & fluid::kStressDivergence) != 0;
  counters_.velocityGradients += (asked_ & (fluid::kVelocity | fluid::kVorticity)) != 0;
  counters_.fractionGradients += (asked_ & fluid::kFraction) != 0;
  counters_.bytesToFluid += double(meeting.totals.particles) * bytesToFluid(dem_);
  counters_.bytesToParticles += double(meeting.totals.particles) * bytesToParticles(asked_);
}

void coupledRun::printRequest(const link::Meeting& meeting) const {
  Info << "coupling, t " << time_.value() << " s: " << label(meeting.totals.particles) << " particles on "
       << returnReduce(mesh_.nCells(), sumOp<label>()) << " cells; the fluid is asked for";
  for (const Asked& quantity : kQuantities)
    if (meeting.needed & quantity.bit)
      Info << " " << quantity.name;
  Info << (meeting.needed ? "" : " nothing") << "; " << label(bytesToFluid(dem_))
       << " bytes per particle to the fluid, " << label(bytesToParticles(meeting.needed)) << " back; spreading length "
       << exchange_->settings().length << " m" << endl;
}

void coupledRun::printCounters() const {
  Info << "computed in " << counters_.meetings << " meetings: pressureGradient " << counters_.pressureGradients
       << " times, stressDivergence " << counters_.stressDivergences << ", velocity gradient "
       << counters_.velocityGradients << ", fraction gradient " << counters_.fractionGradients << "; "
       << counters_.bytesToFluid / kMegabyte << " MB of particles to the fluid, "
       << counters_.bytesToParticles / kMegabyte << " MB of samples back" << endl;
}

} // namespace eccentra

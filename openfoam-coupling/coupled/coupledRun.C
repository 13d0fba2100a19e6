// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A coupled run from its dictionary to its end, over either link.
#include "coupled/coupledRun.H"

#include "coupled/appliedForces.H"
#include "coupled/embeddedDem.h"
#include "coupled/fluidCheckpoint.H"
#include "coupled/statedTerms.H"
#include "flow/caseFiles.H"
#include "flow/periodicDirections.H"
#include "support/arithmeticFault.H"
#include "support/inputError.H"
#include "support/processGuards.H"

#include "link/socket/fluid_server.h"
#include "link/stop_signal.h"

#include "OSspecific.H"
#include "Time.H"

#include <mpi.h>

#include <cfenv>

namespace eccentra {

using namespace Foam;

namespace {

/// Coupling steps from one report to the next.
constexpr label kReportEvery = 10;

IOobject propertiesFile(const Time& time) {
  return IOobject("couplingProperties", time.constant(), time, IOobject::MUST_READ, IOobject::NO_WRITE);
}

/// What the next step needs and a checkpoint has: old time levels and the state of the solver. Nobody looks at them.
bool ofTheCheckpoint(const word& field) {
  return field.endsWith("_0") || field == "withheldForce" || field == "driveResponse";
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
  const Vector<label> periodic = periodicDirections(mesh);
  for (direction k = 0; k < 3; ++k)
    extents.periodic[k] = periodic[k];
  return extents;
}

} // namespace

namespace {

/// Entries that this combination of arguments does not read.
void noteUnread(const dictionary& properties) {
  std::string unread;
  const auto unused = [&](const char* keyword, const std::string& why) {
    if (properties.found(keyword))
      unread += std::string(unread.empty() ? "" : ", ") + keyword + " (" + why + ")";
  };
  const word link(properties.getOrDefault<word>("link", "solver"));
  if (link == "solver")
    for (const char* keyword : {"address", "keys", "timeout", "wait"})
      unused(keyword, "link is solver");
  else
    for (const char* keyword : {"demScript", "demLog"})
      unused(keyword, "link is socket: the script runs in a job of its own");
  const word method(properties.getOrDefault<word>("voidFraction", "diffusion"));
  if (method != "diffusion")
    for (const char* keyword : {"diffusionSteps", "tolerance"})
      unused(keyword, "voidFraction is " + method);
  if (method == "centre" || method == "divided")
    unused("length", "voidFraction is " + method);
  if (!unread.empty())
    note(std::string(properties.name()) + ": without effect: " + unread);
  if (const dictionary* runIn = properties.findDict("runIn"))
    refuseUnknownKeywords(*runIn, {"steps", "deltaT"});
}

} // namespace

coupledRun::coupledRun(fvMesh& mesh, bool verbose, bool resume)
    : mesh_(mesh), time_(const_cast<Time&>(mesh.time())), properties_(propertiesFile(mesh.time())), verbose_(verbose),
      resume_(resume), traps_(fegetexcept()), semiImplicit_(readMomentum(properties_)),
      method_(readVoidFraction(properties_)), timeStep_(time_), writer_(time_, ofTheCheckpoint),
      interval_(time_.controlDict().get<scalar>("deltaT")) {}

coupledRun::~coupledRun() = default;

bool coupledRun::wanted(const Time& time) {
  return isFile(time.globalPath() / time.constant() / "couplingProperties");
}

label coupledRun::reportEvery() const {
  return properties_.getOrDefault<label>("report", kReportEvery);
}

void coupledRun::run() {
  refuseUnknownKeywords(properties_, {"link", "demScript", "demLog", "voidFraction", "length", "diffusionSteps",
                                      "momentum", "mostSolid", "fractionFloor", "tolerance", "report", "runIn",
                                      "address", "keys", "timeout", "wait", "wallsApart", "particlesOutside"});
  noteUnread(properties_);
  const word link(properties_.getOrDefault<word>("link", "solver"));
  if (link != "solver" && link != "socket")
    throw inputError(properties_, "link", link, "use solver or socket");
  if (reportEvery() < 1)
    throw inputError(properties_, "report", reportEvery(), "give a whole number of coupling steps, at least 1");
  const runningMpi mpi;
  link::catch_stop_signals("annulusFoam");
  if (link == "solver")
    hostScript();
  else
    serveSocket();
  time_.functionObjects().end();
  writer_.writeNow();
  writer_.finish();
  fluidCheckpoint::finish(time_);
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
                 resume_ ? std::make_optional(newestCheckpoint()) : std::nullopt);
  link::hosting_solver() = nullptr;
  if (!flow_)
    throw inputError(properties_, "demScript", script, "it never ran a fix fluid/couple with link solver: add one");
}

void coupledRun::serveSocket() {
  overSocket_ = true;
  const fileName address(properties_.get<fileName>("address"));
  link::Timeout patience;
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
      writer_.writeNow();
    throw;
  }
  if (!flow_)
    throw inputError(properties_, "address", address, "the DEM script that came there never ran its fix fluid/couple");
}

link::FluidTerms coupledRun::agree(const link::DemTerms& dem) {
  const trapping on(traps_);
  // A checkpoint brings fields of its own: the flow is made from those of the beginning, not from a folder of a later
  // time that a full disk may have left in pieces.
  if (!flow_)
    fluidCheckpoint::begin(time_, resume_ || dem.resumes.step >= 0, dem.resumes.step);
  if (!flow_)
    flow_ = std::make_unique<averagedFlow>(mesh_, averagedFlow::particles::coupled);
  endOnArithmeticFault(
      "annulusFoam: error: the run has blown up (a division by zero, an overflow or a value that is no number): reduce "
      "deltaT and the DEM time step together, or every, and go on from the last checkpoint with -resume\n");
  link::FluidTerms terms;
  terms.time_step = interval_;
  terms.domain = extentsOf(mesh_);
  terms.offered = exchange::particleExchange::offered();
  if (!flow_->turbulence())
    terms.offered &= ~unsigned(link::kTurbulence);
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

} // namespace eccentra

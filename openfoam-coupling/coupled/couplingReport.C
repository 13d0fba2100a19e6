// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Formats the balances and costs of a coupled run.
#include "coupled/couplingReport.H"

#include "flow/flowMeasures.H"
#include "rheology/particle_reynolds.h"
#include "support/inputError.H"
#include "support/rankSums.H"

#include "OSspecific.H"
#include "Time.H"

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace eccentra {

using namespace Foam;

namespace {

/// Cells with more solid than this belong to the bed.
constexpr double kBedSolid = 0.3;
constexpr int kDigits = 13; ///< of the table
const std::string kHeading =
    "time,particles,mean_velocity,pressure_gradient,solid_concentration,solids_flux,com_x,com_y,com_z,com_height,"
    "bed_height,bed_area,fastest_particle,least_fraction,courant,continuity_error,volume_error,impulse_error,"
    "pressure_error,dem_seconds,fluid_seconds,exchange_seconds,link_seconds,"
    "inserted,left,inserted_mass,mass,global_continuity_error,"
    "momentum_x,momentum_y,momentum_z,fastest_fluid,outside,"
    "particle_reynolds,particle_reynolds_max";
/// Gravity across the axis below this part of the whole counts as none: the hole is vertical.
constexpr double kVertical = 1e-6;

double difference(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

double relative(double error, double scale) {
  return scale > 0 ? error / scale : 0.0;
}

std::string millimetres(double metres) {
  std::ostringstream text;
  text.precision(3);
  text << 1e3 * metres << " mm";
  return text.str();
}

vector vectorOf(const double* v) {
  return vector(v[0], v[1], v[2]);
}

/// Reynolds numbers of all particles at the mean slip since the last coupling step, which is what drag gave over its
/// coefficient. Both are 0 without drag or without a Herschel-Bulkley law. Collective.
struct SlipReynolds {
  double mean = 0, largest = 0;
  SlipReynolds(const averagedFlow& flow, const link::ParticleArrays& particles, double elapsed) {
    const rheology::HerschelBulkley law = kinematicLaw(flow.rheology());
    std::array<double, 2> sums{};
    if (law.k > 0 && elapsed > 0 && particles.impulse && particles.drag_coefficient) {
      for (std::size_t i = 0; i < particles.count; ++i) {
        if (!(particles.drag_coefficient[i] > 0))
          continue;
        const double slip = mag(vectorOf(particles.impulse[i])) / particles.drag_coefficient[i];
        const double diameter = std::cbrt(6 / constant::mathematical::pi * particles.volume[i]);
        const double number = rheology::particle_reynolds(law, slip, diameter);
        sums[0] += number;
        sums[1] += 1;
        largest = std::max(largest, number);
      }
    }
    exchange::sumOverRanks(sums);
    mean = relative(sums[0], sums[1]);
    largest = returnReduce(largest, maxOp<double>());
  }
};

} // namespace

CostByPart::CostByPart(const link::CouplingStep& couplingStep) {
  dem = {couplingStep.dem_seconds, couplingStep.load.between};
  dem.between.waited = couplingStep.dem_seconds - couplingStep.load.mean_seconds;
  link.wall = couplingStep.pack_seconds;
}

CostByPart& CostByPart::operator+=(const CostByPart& more) {
  dem += more.dem;
  fluid += more.fluid;
  exchange += more.exchange;
  link += more.link;
  together += more.together;
  return *this;
}

couplingReport::couplingReport(const fvMesh& mesh, const link::DemTerms& dem, int every, const dictionary* earlier)
    : mesh_(mesh), every_(every), interval_(dem.time_step * dem.interval), stepsPerCouplingStep_(dem.interval),
      started_(std::chrono::steady_clock::now()) {
  const vector gravity(vectorOf(dem.gravity));
  const vector across(gravity - axis_ * (axis_ & gravity));
  if (mag(across) > kVertical * mag(gravity))
    down_ = across / mag(across);
  scalar lowest = -GREAT;
  for (const point& p : mesh.points())
    lowest = max(lowest, p & down_);
  lowest_ = returnReduce(lowest, maxOp<scalar>());
  const boundBox box(mesh.points(), true);
  length_ = box.span() & axis_;
  if (earlier) {
    couplingSteps_ = earlier->get<label>("couplingSteps");
    initially_ = std::llround(earlier->get<scalar>("initially"));
    before_ = {earlier->get<scalar>("dem"), earlier->get<scalar>("fluid"), earlier->get<scalar>("exchange"),
               earlier->get<scalar>("link")};
  }
  if (Pstream::master())
    openTable(earlier);
}

void couplingReport::head(const averagedFlow& flow) {
  const std::string text = regimeHead(flow);
  if (Pstream::master()) {
    std::printf("%s", text.c_str());
    std::fflush(stdout);
  }
}

void couplingReport::openTable(const dictionary* earlier) {
  const fileName folder(mesh_.time().globalPath() / "postProcessing" / "eccentra");
  mkDir(folder);
  // Rows that the earlier run wrote after its checkpoint come again.
  table_ = std::make_unique<link::DurableTable>(folder / "coupling.csv", kHeading + flowMeasures::columns(mesh_),
                                                earlier != nullptr, mesh_.time().value());
  if (earlier) {
    const label missing = earlier->getOrDefault<label>("rows", 0) - label(table_->rows());
    if (missing > 0)
      std::printf("warning: coupling.csv lacks %d rows that the checkpoint's run had written: those that are there "
                  "are kept\n",
                  int(missing));
    for (const string& row : earlier->getOrDefault<List<string>>("pendingRows", List<string>()))
      table_->add(row);
  }
  for (const std::string& message : table_->take_messages())
    std::printf("%s\n", message.c_str());
}

void couplingReport::addRow(const std::string& row) {
  table_->add(row);
  for (const std::string& message : table_->take_messages())
    std::printf("%s\n", message.c_str());
}

std::array<double, 4> couplingReport::parts() const {
  return {before_[0] + total_.dem.wall, before_[1] + total_.fluid.wall, before_[2] + total_.exchange.wall,
          before_[3] + total_.link.wall};
}

dictionary couplingReport::state() const {
  dictionary state;
  state.add("couplingSteps", label(couplingSteps_));
  state.add("initially", scalar(initially_));
  const std::array<double, 4> parts = this->parts();
  state.add("dem", parts[0]);
  state.add("fluid", parts[1]);
  state.add("exchange", parts[2]);
  state.add("link", parts[3]);
  if (table_) {
    table_->sync();
    state.add("rows", label(table_->rows()));
    List<string> pending(label(table_->pending().size()));
    forAll(pending, i) pending[i] = table_->pending()[std::size_t(i)];
    state.add("pendingRows", pending);
  }
  return state;
}

// What is on its way from one side to the other counts: the force that semi-implicit drag held back, and the pressure
// and viscous forces that the particles receive until the next coupling step or are still pending.
vector couplingReport::totalMomentum(averagedFlow& flow, const exchange::particleExchange& exchange,
                                     const link::CouplingStep& couplingStep) const {
  const scalar step = mesh_.time().deltaTValue();
  const vectorField& withheld = flow.withheldForce().primitiveField();
  const vectorField perVolume(flow.alpha().primitiveField() * flow.U().primitiveField() + step * withheld);
  const vector fluid(flow.rho() * gSum(vectorField(mesh_.V() * perVolume)));
  return vectorOf(couplingStep.totals.momentum) + fluid + interval_ * vectorOf(exchange.balance().pendingForce.data());
}

couplingReport::Bed couplingReport::bed(const volScalarField& alpha) const {
  Bed bed;
  scalar highest = lowest_;
  scalar volume = 0;
  forAll(alpha, celli) {
    if (1.0 - alpha[celli] < kBedSolid)
      continue;
    highest = min(highest, mesh_.C()[celli] & down_);
    volume += mesh_.V()[celli];
  }
  bed.height = lowest_ - returnReduce(highest, minOp<scalar>());
  bed.area = returnReduce(volume, sumOp<scalar>()) / length_;
  bed.minFraction = gMin(alpha.primitiveField());
  return bed;
}

void couplingReport::add(averagedFlow& flow, const exchange::particleExchange& exchange,
                         const link::CouplingStep& couplingStep, const link::ParticleArrays& particles,
                         const CostByPart& cost, const vector& onItsWay) {
  total_ += cost;
  // Crossing between ranks is the link's work, wherever it is done.
  const exchange::particlePoints::Traffic& traffic = exchange.present().traffic();
  const Cost crossing = traffic.cost - traffic_.cost;
  total_.exchange += Cost{} - crossing;
  total_.link += crossing;
  traffic_ = traffic;
  ++couplingStepsHere_;
  steps_ += couplingStep.elapsed > 0;
  demLoad_.add(couplingStep);
  points_ += double(exchange.present().here().size());
  const bool last = couplingStep.steps_total > 0 && couplingStep.steps_done >= couplingStep.steps_total;
  if (couplingSteps_++ % every_ == 0 || last)
    write(flow, exchange, couplingStep, particles, onItsWay);
}

void couplingReport::write(averagedFlow& flow, const exchange::particleExchange& exchange,
                           const link::CouplingStep& couplingStep, const link::ParticleArrays& particles,
                           const vector& onItsWay) {
  const exchange::ExchangeBalance& balance = exchange.balance();
  const link::DemTotals& totals = couplingStep.totals;
  const Bed bed = this->bed(flow.alpha());
  const double solid = totals.volume > 0 ? totals.volume : 1.0;
  const vector centre(vectorOf(totals.volume_position) / solid);
  const double meanVelocity = flow.superficialVelocity() & axis_;
  if (!std::isfinite(meanVelocity) || !std::isfinite(totals.fastest))
    throw inputError("the coupled run has blown up at t = " + mesh_.time().timeName() + " s: the " +
                     (std::isfinite(totals.fastest) ? "fluid's velocity" : "particles' velocity") +
                     " is no number; reduce deltaT and the DEM time step together, or every");
  const double courant = flow.CourantNo();
  const double continuity = flow.continuityError();
  const vector momentum(totalMomentum(flow, exchange, couplingStep) + onItsWay);
  const double fastestFluid = gMax(mag(flow.U().primitiveField())());
  const double globalContinuity = flow.globalContinuityError();
  if (initially_ < 0)
    initially_ = totals.particles - totals.inserted;
  left_ = initially_ + totals.inserted - totals.particles;
  outside_ = std::int64_t(balance.outside);
  const flowMeasures measures(flow);
  const SlipReynolds slip(flow, particles, couplingStep.elapsed);
  const double gradient = measures.gradient;
  const double concentration = totals.volume / gSum(mesh_.V());
  const double flux = (vectorOf(totals.volume_velocity) & axis_) / length_;
  const double volumeError = relative(std::abs(balance.meshVolume - balance.particleVolume), balance.particleVolume);
  const double impulseError = relative(difference(balance.meshImpulse, balance.particleImpulse), balance.impulseScale);
  const double pressureError =
      relative(difference(balance.meshPressureForce, balance.particlePressureForce), balance.pressureForceScale);
  std::array<double, 4> parts = this->parts();
  for (double& part : parts)
    part = returnReduce(part, sumOp<scalar>()) / Pstream::nProcs();
  if (!balance.fits)
    Info << "warning: more solid than mostSolid allows in some cells: take smaller particles per cell, or voidFraction "
            "diffusion"
         << endl;
  warn(flow, measures.Reynolds);
  if (!Pstream::master())
    return;
  std::ostringstream row;
  row.precision(kDigits);
  row << mesh_.time().value() << ',' << totals.particles << ',' << meanVelocity << ',' << gradient << ','
      << concentration << ',' << flux << ',' << centre.x() << ',' << centre.y() << ',' << centre.z() << ','
      << (totals.particles ? lowest_ - (centre & down_) : 0.0) << ',' << bed.height << ',' << bed.area << ','
      << totals.fastest << ',' << bed.minFraction << ',' << courant << ',' << continuity << ',' << volumeError << ','
      << impulseError << ',' << pressureError;
  for (const double part : parts)
    row << ',' << part;
  row << ',' << totals.inserted << ',' << left_ << ',' << totals.inserted_mass << ',' << totals.mass << ','
      << globalContinuity << ',' << momentum.x() << ',' << momentum.y() << ',' << momentum.z() << ',' << fastestFluid
      << ',' << outside_ << ',' << slip.mean << ',' << slip.largest << measures.values();
  addRow(row.str());

  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  const double done =
      couplingStep.steps_total > 0 ? double(couplingStep.steps_done) / double(couplingStep.steps_total) : 0.0;
  // Across a vertical hole there is no low side on which a bed could lie.
  const std::string height =
      down_ != vector(Zero) ? "bed " + millimetres(bed.height) : "solid's centre at " + millimetres(centre & axis_);
  std::printf("t %.4g s  %3.0f %%  left %.0f s | %lld particles, concentration %.3g %%, %s, U %.4g m/s, dp/dz %.4g "
              "Pa/m, flux %.3g m3/s, fastest %.3g m/s, alpha >= %.3f | %s  particles' Re %.3g, at most %.3g | errors: "
              "volume %.1e impulse %.1e pressure %.1e continuity %.1e\n",
              mesh_.time().value(), 100 * done, done > 0 ? elapsed * (1 - done) / done : 0.0,
              static_cast<long long>(totals.particles), 100 * concentration, height.c_str(), meanVelocity, gradient,
              flux, totals.fastest, bed.minFraction, measures.text().c_str(), slip.mean, slip.largest, volumeError,
              impulseError, pressureError, continuity);
  std::fflush(stdout);
}

void couplingReport::warn(averagedFlow& flow, const ReynoldsNumbers& Reynolds) {
  const std::string convergence = flow.convergence().news(mesh_.time().timeName());
  const std::string turbulence = warnedOfTurbulence_ ? "" : regimeWarning(flow, Reynolds);
  const std::string inlet = warnedOfInlet_ ? "" : inletWarning(flow);
  warnedOfTurbulence_ = warnedOfTurbulence_ || !turbulence.empty();
  warnedOfInlet_ = warnedOfInlet_ || !inlet.empty();
  if (Pstream::master())
    std::printf("%s%s%s", convergence.c_str(), turbulence.c_str(), inlet.c_str());
}

void couplingReport::finish(averagedFlow& flow) const {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  const auto mean = [](double part) { return returnReduce(part, sumOp<scalar>()) / Pstream::nProcs(); };
  const auto line = [&](const char* name, const Cost& part) {
    const double wall = mean(part.wall), waited = mean(part.between.waited);
    if (Pstream::master())
      std::printf("  %-10s %9.2f s %5.1f %%   of these waiting for other ranks %5.1f %%\n", name, wall,
                  100 * wall / elapsed, wall > 0 ? 100 * waited / wall : 0.0);
    return wall;
  };
  if (Pstream::master())
    std::printf("cost by part, mean over %d rank(s)\n", Pstream::nProcs());
  const double dem = line("DEM", total_.dem), fluid = line("fluid", total_.fluid);
  const double exchange = line("exchange", total_.exchange), link = line("link", total_.link);
  const double together = mean(total_.together);
  if (Pstream::master()) {
    if (together > 0)
      std::printf("  %-10s %9.2f s %5.1f %%   DEM and fluid at the same time\n", "both", together,
                  100 * together / elapsed);
    const double rest = elapsed - (together > 0 ? together : dem + fluid) - exchange - link;
    std::printf("  %-10s %9.2f s %5.1f %%\n", "rest", rest, 100 * rest / elapsed);
  }
  printLoad();
  printSent();
  printLink(link, dem, fluid);
  const std::string turbulence = turbulenceSummary(flow);
  if (Pstream::master())
    std::printf("%s%s", turbulence.c_str(), flow.convergence().summary().c_str());
  if (Pstream::master() && (left_ > 0 || outside_ > 0))
    std::printf("particles that have left the simulation box: %lld; that lie outside the mesh: %lld\n",
                static_cast<long long>(left_), static_cast<long long>(outside_));
  const label pending = returnReduce(table_ ? label(table_->pending().size()) : 0, maxOp<label>());
  if (pending > 0)
    throw link::Refusal("the last " + std::to_string(pending) + " rows of coupling.csv found no room on the disk" +
                        (table_ ? " (" + table_->problem() + ")" : "") +
                        ": make room and go on from the last checkpoint with -resume");
}

// What another network would cost follows from numbers that do not depend on this machine.
void couplingReport::printSent() const {
  std::ostringstream line;
  line.precision(4);
  const auto part = [&](const char* name, const Cost& cost) {
    const std::array<double, 3> counts{cost.between.messages, cost.between.bytes, cost.between.operations};
    line << name;
    for (std::size_t k = 0; k < counts.size(); ++k)
      line << returnReduce(counts[k], sumOp<scalar>()) / Pstream::nProcs() / couplingStepsHere_ * (k == 1 ? 1e-3 : 1)
           << std::array{" messages, ", " kB, ", " operations of all ranks"}[k];
  };
  part("DEM ", total_.dem);
  part("; fluid ", total_.fluid);
  part("; exchange ", total_.exchange);
  part("; link ", total_.link);
  if (Pstream::master() && (Pstream::nProcs() > 1 || demLoad_.ranks() > 1))
    std::printf("sent by a rank in a coupling step, mean: %s\n", line.str().c_str());
}

// The link beside what it links: a step of either side.
void couplingReport::printLink(double link, double dem, double fluid) const {
  const double sent = returnReduce(traffic_.bytes, sumOp<scalar>()),
               most = returnReduce(traffic_.bytes, maxOp<scalar>());
  if (!Pstream::master() || steps_ == 0)
    return;
  const double couplingStep = link / couplingStepsHere_, demStep = dem / (double(steps_) * stepsPerCouplingStep_),
               fluidStep = fluid / steps_;
  std::printf("link: %.3f ms a coupling step, %.3g DEM steps or %.3g fluid intervals; %.3g kB a coupling step between "
              "ranks of the fluid, at most %.3g from one rank\n",
              1e3 * couplingStep, demStep > 0 ? couplingStep / demStep : 0.0,
              fluidStep > 0 ? couplingStep / fluidStep : 0.0, 1e-3 * sent / couplingStepsHere_,
              1e-3 * most / couplingStepsHere_);
  std::fflush(stdout);
}

// What a rank computes besides waiting tells how even the division is.
void couplingReport::printLoad() const {
  const auto uneven = [](double mine) {
    const double sum = returnReduce(mine, sumOp<scalar>());
    return sum > 0 ? returnReduce(mine, maxOp<scalar>()) * Pstream::nProcs() / sum : 1.0;
  };
  const double cells = uneven(mesh_.nCells()), points = uneven(points_);
  const double fluid = uneven(total_.fluid.wall - total_.fluid.between.waited);
  const double exchange = uneven(total_.exchange.wall - total_.exchange.between.waited);
  if (!Pstream::master())
    return;
  std::printf("%s", demLoad_.table().c_str());
  std::printf(
      "load of %d rank(s) of the fluid, fullest or busiest over mean: cells %.3f, particles %.3f, computing the "
      "flow %.3f, the exchange %.3f\n",
      Pstream::nProcs(), cells, points, fluid, exchange);
  std::fflush(stdout);
}

} // namespace eccentra

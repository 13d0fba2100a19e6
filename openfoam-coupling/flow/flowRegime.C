// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reynolds numbers from sums over the mesh.
#include "flow/flowRegime.H"

#include "flow/averagedFlow.H"
#include "flow/flowMeasures.H"
#include "rheology/yieldStressViscosity.H"
#include "support/rankSums.H"

#include "turbulenceModel.H"
#include "wallPolyPatch.H"

#include <array>
#include <sstream>

namespace Foam {

namespace rheology = eccentra::rheology;

namespace {

/// Half of the sector of the wide side whose flow counts.
const scalar cosOfSector = std::cos(constant::mathematical::pi / 12);
/// A smaller offset, over the radius of the hole, is none.
const scalar concentric = 1e-6;

rheology::HerschelBulkley knownLaw(const averagedFlow& flow) {
  return kinematicLaw(flow.rheology());
}

/// Axis and mean radius of a patch [m].
struct cylinder {
  point centre{Zero};
  scalar radius = 0;
  cylinder(const fvPatch& patch, const vector& axis) {
    const scalarField& area = patch.magSf();
    std::array<double, 4> sums{sum(area), 0, 0, 0};
    const vector moment(sum(vectorField(area * patch.Cf())));
    for (direction k = 0; k < 3; ++k) {
      sums[k + 1] = moment[k];
    }
    eccentra::exchange::sumOverRanks(sums);
    if (!(sums[0] > 0)) {
      return;
    }
    centre = vector(sums[1], sums[2], sums[3]) / sums[0];
    const vectorField arm(patch.Cf() - centre);
    radius = gSum(scalarField(area * mag(arm - axis * (axis & arm)))) / sums[0];
  }
};

/// Mean of alpha U along the axis over the cells in the sector of the wide side [m/s].
scalar wideVelocity(const averagedFlow& flow, const annulusOfMesh& annulus) {
  const fvMesh& mesh = flow.mesh();
  const vector& axis = flowAxis(flow);
  const vectorField arm(mesh.C().primitiveField() - annulus.pipeCentre);
  const vectorField across(arm - axis * (axis & arm));
  const scalarField cosine((across & annulus.wideSide) / max(mag(across), scalar(VSMALL)));
  // Of a coarse mesh at least the column that is nearest.
  const scalar least = min(cosOfSector, gMax(cosine) * (1 - SMALL));
  const volScalarField* const alpha = flow.coupled() ? &mesh.lookupObject<volScalarField>("alpha") : nullptr;
  std::array<double, 2> sums{};
  forAll(cosine, celli) {
    if (cosine[celli] >= least) {
      sums[0] += mesh.V()[celli];
      sums[1] += mesh.V()[celli] * (alpha ? (*alpha)[celli] : 1) * (flow.U()[celli] & axis);
    }
  }
  eccentra::exchange::sumOverRanks(sums);
  return mag(sums[1]) / sums[0];
}

/// Hydraulic diameter 4 V/A [m] and mean viscosity at the walls [m2/s].
struct wallMeans {
  scalar diameter = 0, nu = 0;
  explicit wallMeans(const averagedFlow& flow) {
    const fvMesh& mesh = flow.mesh();
    std::array<double, 3> sums{0, 0, sum(mesh.V().field())};
    for (const label patchi : wallPatches(mesh)) {
      const scalarField& magSf = mesh.magSf().boundaryField()[patchi];
      sums[0] += sum(magSf);
      sums[1] += sum(magSf * flow.rheology().nu(patchi));
    }
    eccentra::exchange::sumOverRanks(sums);
    if (sums[0] > 0) {
      diameter = 4 * sums[2] / sums[0];
      nu = sums[1] / sums[0];
    }
  }
};

/// Mean of alpha U that the entries of the case prescribe [m/s]; 0 where they do not.
scalar prescribedVelocity(const averagedFlow& flow, const annulusOfMesh& annulus) {
  const drivingGradient& drive = flow.drive();
  const fvMesh& mesh = flow.mesh();
  if (drive.controlsVelocity()) {
    return mag(drive.target());
  }
  if (drive.active()) {
    const rheology::HerschelBulkley law = knownLaw(flow);
    return annulus.found && law.k > 0 ? rheology::slots_velocity(law, annulus.gap, mag(drive.G())) : 0;
  }
  scalar inflow = 0;
  forAll(mesh.boundary(), patchi) {
    const fvPatchVectorField& U = flow.U().boundaryField()[patchi];
    if (U.fixesValue() && !U.coupled() && !isA<wallPolyPatch>(mesh.boundaryMesh()[patchi])) {
      inflow += sum(max(-(U & mesh.boundary()[patchi].Sf()), scalar(0)));
    }
  }
  std::array<double, 2> sums{inflow, sum(mesh.V().field())};
  eccentra::exchange::sumOverRanks(sums);
  return sums[0] * (boundBox(mesh.points(), true).span() & flowAxis(flow)) / sums[1];
}

const char* nameOf(regime flowing) {
  switch (flowing) {
  case regime::laminar:
    return "laminar";
  case regime::transitional:
    return "transitional";
  default:
    return "turbulent";
  }
}

scalar indexOf(const averagedFlow& flow) {
  const rheology::HerschelBulkley law = knownLaw(flow);
  return law.k > 0 ? law.n : 1;
}

} // namespace

rheology::HerschelBulkley kinematicLaw(const viscosityModel& model) {
  if (const auto* ours = dynamic_cast<const viscosityModels::yieldStressViscosity*>(&model)) {
    return ours->kinematic();
  }
  const dictionary& properties = model.viscosityProperties();
  const word type(properties.get<word>("transportModel"));
  const dictionary& coeffs = properties.optionalSubDict(type + "Coeffs");
  // Dimensions vary with the index: the number alone counts.
  const auto number = [&coeffs](const char* keyword) {
    dimensionedScalar read(keyword, dimless, 0);
    coeffs.lookup(keyword) >> read;
    return read.value();
  };
  const auto index = [&] { return dimensionedScalar("n", dimless, coeffs).value(); };
  if (type == "Newtonian") {
    return {0, dimensionedScalar("nu", dimViscosity, properties).value(), 1, GREAT};
  }
  if (type == "powerLaw") {
    return {0, number("k"), index(), GREAT};
  }
  if (type == "HerschelBulkley") {
    return {number("tau0"), number("k"), index(), GREAT};
  }
  return {0, 0, 0, 0};
}

annulusOfMesh::annulusOfMesh(const averagedFlow& flow) {
  const fvMesh& mesh = flow.mesh();
  const label pipei = mesh.boundaryMesh().findPatchID("pipe"), holei = mesh.boundaryMesh().findPatchID("hole");
  if (pipei < 0 || holei < 0) {
    return;
  }
  const vector& axis = flowAxis(flow);
  const cylinder pipe(mesh.boundary()[pipei], axis), hole(mesh.boundary()[holei], axis);
  vector away(hole.centre - pipe.centre);
  away -= axis * (axis & away);
  gap = {pipe.radius, hole.radius, mag(away)};
  found = pipe.radius > 0 && hole.radius > pipe.radius + gap.offset;
  pipeCentre = pipe.centre;
  if (gap.offset > concentric * hole.radius) {
    wideSide = away / gap.offset;
  }
}

ReynoldsNumbers ReynoldsOf(const averagedFlow& flow) {
  const wallMeans walls(flow);
  if (!(walls.diameter > 0)) {
    return {};
  }
  const rheology::HerschelBulkley law = knownLaw(flow);
  const auto number = [&](scalar diameter, scalar U) {
    return law.k > 0 ? rheology::metzner_reed(law, diameter, U) : U * diameter / walls.nu;
  };
  ReynoldsNumbers numbers;
  numbers.mean = numbers.wide = number(walls.diameter, mag(flow.superficialVelocity()));
  const annulusOfMesh annulus(flow);
  if (annulus.found && mag(annulus.wideSide) > 0) {
    numbers.wide = number(2 * annulus.gap.widest(), wideVelocity(flow, annulus));
  }
  return numbers;
}

regime regimeOf(const averagedFlow& flow, scalar Reynolds) {
  const scalar n = indexOf(flow);
  if (Reynolds > rheology::turbulent_limit(n)) {
    return regime::turbulent;
  }
  return Reynolds > rheology::laminar_limit(n) ? regime::transitional : regime::laminar;
}

std::string regimeText(const averagedFlow& flow, const ReynoldsNumbers& numbers) {
  const regime mean = regimeOf(flow, numbers.mean), wide = regimeOf(flow, numbers.wide);
  return std::string(nameOf(mean)) + (wide == mean ? "" : std::string(", wide gap ") + nameOf(wide));
}

std::string regimeHead(const averagedFlow& flow) {
  const rheology::HerschelBulkley law = knownLaw(flow);
  const wallMeans walls(flow);
  const annulusOfMesh annulus(flow);
  const scalar U = prescribedVelocity(flow, annulus);
  if (!(law.k > 0) || !(walls.diameter > 0) || !(U > 0)) {
    return "";
  }
  ReynoldsNumbers numbers;
  numbers.mean = numbers.wide = rheology::metzner_reed(law, walls.diameter, U);
  std::ostringstream text;
  text.precision(4);
  text << "Reynolds number (Metzner-Reed) at " << U << " m/s: " << numbers.mean;
  if (annulus.found && mag(annulus.wideSide) > 0) {
    const scalar wideU = rheology::wide_gap_velocity(law, annulus.gap, U);
    numbers.wide = rheology::metzner_reed(law, 2 * annulus.gap.widest(), wideU);
    text << " in the mean, " << numbers.wide << " in the wide gap (" << wideU << " m/s, slots side by side, no bed)";
  }
  text << "; laminar below " << rheology::laminar_limit(law.n) << ", turbulent above "
       << rheology::turbulent_limit(law.n) << ": " << regimeText(flow, numbers) << '\n';
  return text.str();
}

std::string regimeWarning(const averagedFlow& flow, const ReynoldsNumbers& numbers) {
  if (flow.turbulence()) {
    const scalar least = rheology::turbulent_limit(indexOf(flow)), largest = max(numbers.mean, numbers.wide);
    if (largest > least || !(largest > 0)) {
      return "";
    }
    std::ostringstream text;
    text.precision(4);
    text << "warning: the largest Reynolds number of the flow is " << largest << ", below " << least
         << ", above which this fluid is turbulent (Dodge and Metzner): " << flow.turbulence()->type()
         << " knows no transition, and friction comes out too high; give simulationType laminar in "
            "constant/turbulenceProperties\n";
    return text.str();
  }
  const scalar limit = rheology::laminar_limit(indexOf(flow));
  const bool mean = numbers.mean > limit;
  if (!mean && !(numbers.wide > limit)) {
    return "";
  }
  std::ostringstream text;
  text.precision(4);
  text << "warning: the Reynolds number of the " << (mean ? "mean flow is " : "flow in the wide gap is ")
       << (mean ? numbers.mean : numbers.wide) << ", above the laminar limit " << limit
       << " of this fluid (Dodge and Metzner), but the flow is computed as laminar: there is no turbulence model, and "
          "pressure drop and forces on walls come out too low; give simulationType RAS in "
          "constant/turbulenceProperties\n";
  return text.str();
}

} // namespace Foam

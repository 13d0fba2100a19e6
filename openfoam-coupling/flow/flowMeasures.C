// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals over walls and ends of the mesh.
#include "flow/flowMeasures.H"

#include "flow/averagedFlow.H"

#include "fvcGrad.H"
#include "turbulenceModel.H"
#include "wallPolyPatch.H"

#include <algorithm>
#include <sstream>

namespace Foam {

vector flowAxis(const averagedFlow& flow) {
  return flow.drive().axis();
}

labelList wallPatches(const fvMesh& mesh) {
  labelList walls;
  forAll(mesh.boundaryMesh(), patchi) {
    if (isA<wallPolyPatch>(mesh.boundaryMesh()[patchi])) {
      walls.append(patchi);
    }
  }
  return walls;
}

std::vector<wallLoad> wallLoads(const averagedFlow& flow) {
  const fvMesh& mesh = flow.mesh();
  const tmp<volTensorField> gradU = fvc::grad(flow.U(), "grad(U)");
  std::vector<wallLoad> loads;
  for (const label patchi : wallPatches(mesh)) {
    const fvPatch& patch = mesh.boundary()[patchi];
    const vectorField& Sf = patch.Sf();
    const vectorField& Cf = patch.Cf();
    const scalarField& magSf = patch.magSf();
    const scalarField nu(flow.nuEff(patchi));
    const tensorField& gradient = gradU().boundaryField()[patchi];
    const scalarField& p = flow.p().boundaryField()[patchi];
    const scalar area = gSum(magSf);
    const vector centroid = area > 0 ? vector(gSum(vectorField(magSf * Cf)) / area) : vector(Zero);
    // Areas point out of the fluid, into the wall.
    const vectorField force(flow.rho() * (Sf * p - nu * (Sf & dev(twoSymm(gradient)))));
    const vector torque = gSum(vectorField((Cf - centroid) ^ force));
    loads.push_back({patch.name(), gSum(force), torque & flowAxis(flow)});
  }
  return loads;
}

scalar pressureGradientOf(const averagedFlow& flow) {
  const fvMesh& mesh = flow.mesh();
  const label inlet = mesh.boundaryMesh().findPatchID("inlet");
  const label outlet = mesh.boundaryMesh().findPatchID("outlet");
  // Periodic ends cost nothing by themselves, and are empty where they lie between ranks.
  if (flow.drivingPressureGradient() != 0 || inlet < 0 || outlet < 0 || mesh.boundaryMesh()[inlet].coupled()) {
    return flow.drivingPressureGradient();
  }
  const auto mean = [&](label patch) {
    const scalarField& areas = mesh.magSf().boundaryField()[patch];
    return gSum(scalarField(areas * flow.p().boundaryField()[patch])) / gSum(areas);
  };
  return flow.rho() * (mean(inlet) - mean(outlet)) / (boundBox(mesh.points(), true).span() & flowAxis(flow));
}

wallDistances wallDistancesOf(const averagedFlow& flow) {
  List<scalarField> all(Pstream::nProcs());
  scalarField& own = all[Pstream::myProcNo()];
  for (const label patchi : wallPatches(flow.mesh())) {
    const fvPatchVectorField& U = flow.U().boundaryField()[patchi];
    const scalarField stress(flow.nuEff(patchi) * mag(U.snGrad()));
    const scalarField nu(flow.rheology().nu(patchi));
    const scalarField& y = flow.turbulence()->y()[patchi];
    forAll(y, facei) own.append(y[facei] * std::sqrt(stress[facei]) / nu[facei]);
  }
  Pstream::gatherList(all);
  wallDistances distances;
  if (Pstream::master()) {
    std::vector<scalar> values;
    for (const scalarField& part : all) {
      values.insert(values.end(), part.begin(), part.end());
    }
    if (!values.empty()) {
      const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      distances.median = *middle;
      distances.largest = *std::max_element(values.begin(), values.end());
    }
  }
  return distances;
}

std::string turbulenceSummary(const averagedFlow& flow) {
  if (!flow.turbulence()) {
    return "";
  }
  const wallDistances distances = wallDistancesOf(flow);
  std::ostringstream text;
  text.precision(3);
  text << "turbulence by " << flow.turbulence()->type() << ": y+ of the first cells is " << distances.median
       << " in the median, " << distances.largest
       << " at most; wall functions of the logarithmic law hold from 30 to 300\n";
  return text.str();
}

std::string inletWarning(averagedFlow& flow) {
  // Below this fluid fraction the two velocities differ by more than a hundredth.
  constexpr scalar kClear = 0.99;
  forAll(flow.mesh().boundary(), patchi) {
    const fvPatchVectorField& U = flow.U().boundaryField()[patchi];
    const fvPatch& patch = flow.mesh().boundary()[patchi];
    if (!U.fixesValue() || U.coupled() || isA<wallPolyPatch>(patch.patch()) ||
        U.type() == "interstitialInletVelocity") {
      continue;
    }
    const scalarField inflow(max(-(U & patch.Sf()), scalar(0)));
    const scalar entering = gSum(inflow);
    const scalar entersBeside = gSum(scalarField(inflow * flow.alpha().boundaryField()[patchi]));
    if (entering > 0 && entersBeside < kClear * entering) {
      std::ostringstream text;
      text.precision(3);
      text << "warning: 0/U: " << patch.name() << " is of type '" << U.type()
           << "' and has particles beside it: its velocity is that between the particles, so that " << entersBeside
           << " of " << entering
           << " m3/s of fluid enter; give type interstitialInletVelocity with inletVelocity for a superficial "
              "velocity\n";
      return text.str();
    }
  }
  return "";
}

flowMeasures::flowMeasures(averagedFlow& flow)
    : gradient(pressureGradientOf(flow)), Reynolds(ReynoldsOf(flow)), flowing(regimeOf(flow, Reynolds.wide)),
      regimes(regimeText(flow, Reynolds)), residual(flow.momentumResidual()), loads(wallLoads(flow)) {}

std::string flowMeasures::columns(const fvMesh& mesh) {
  std::string names = ",reynolds,reynolds_wide,regime,momentum_residual";
  for (const label patchi : wallPatches(mesh)) {
    for (const char* what : {"_force_x", "_force_y", "_force_z", "_torque"}) {
      names += "," + mesh.boundary()[patchi].name() + what;
    }
  }
  return names;
}

std::string flowMeasures::values() const {
  std::ostringstream os;
  os.precision(13);
  os << ',' << Reynolds.mean << ',' << Reynolds.wide << ',' << int(flowing) << ',' << residual;
  for (const wallLoad& load : loads) {
    os << ',' << load.force.x() << ',' << load.force.y() << ',' << load.force.z() << ',' << load.torque;
  }
  return os.str();
}

std::string flowMeasures::text() const {
  std::ostringstream os;
  os.precision(4);
  os << "Re " << Reynolds.mean;
  if (Reynolds.wide != Reynolds.mean) {
    os << " wide gap " << Reynolds.wide;
  }
  os << " (" << regimes << ')';
  for (const wallLoad& load : loads) {
    os << "  " << load.patch << " |F| " << mag(load.force) << " N torque " << load.torque << " N m";
  }
  return os.str();
}

} // namespace Foam

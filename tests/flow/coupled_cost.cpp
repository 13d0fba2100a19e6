// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// For scripts/solver-cost: steps of the averaged flow with all fields of the particles (alpha = 0.9), on the case
// given.
#include "flow/averagedFlow.H"
#include "support/inputError.H"

#include "Time.H"
#include "argList.H"
#include "fvMesh.H"

using namespace Foam;

int main(int argc, char* argv[]) {
  const argList args(argc, argv);
  runReportingErrors("coupled_cost", [&] {
    Time runTime(Time::controlDictName, args);
    fvMesh mesh(IOobject(fvMesh::defaultRegion, runTime.timeName(), runTime, IOobject::MUST_READ));
    averagedFlow flow(mesh, averagedFlow::particles::coupled);
    flow.alpha() = dimensionedScalar("alpha", dimless, 0.9);
    flow.resetFractionHistory();
    flow.exchange() = dimensionedScalar("exchange", dimless / dimTime, 10);
    messageStream::level = 0;
    while (runTime.run()) {
      ++runTime;
      flow.advance();
    }
  });
  return 0;
}

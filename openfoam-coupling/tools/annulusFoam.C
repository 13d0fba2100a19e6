// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// annulusFoam: flow of a generalised-Newtonian fluid in an annulus (or any other mesh), alone or with particles.
#include "coupled/coupledRun.H"
#include "coupled/fluidCheckpoint.H"
#include "flow/averagedFlow.H"
#include "flow/caseFiles.H"
#include "flow/flowProgress.H"
#include "flow/timeStepControl.H"
#include "support/arithmeticFault.H"
#include "support/commonOptions.H"
#include "support/fieldWriter.H"
#include "support/inputError.H"
#include "support/openfoamFolder.H"
#include "support/patientOutput.H"

#include "link/checkpoint/resume_command.h"

#include "Time.H"
#include "argList.H"
#include "fvMesh.H"

using namespace Foam;

namespace {

void run(const argList& args) {
  if (!args.checkRootCase()) {
    throw inputError("no case in " + args.path() + ": give its folder with -case, or change into it");
  }
  if (args.found("resume")) {
    eccentra::fluidCheckpoint::clearHalfWritten(args.globalPath(), args.path());
  }
  Time runTime(Time::controlDictName, args);
  checkCaseFiles(runTime);
  fvMesh mesh(IOobject(fvMesh::defaultRegion, runTime.timeName(), runTime, IOobject::MUST_READ));
  checkSolutionControls(mesh.solutionDict(), turbulent(runTime));
  if (eccentra::coupledRun::wanted(runTime)) {
    eccentra::coupledRun(mesh, args.found("verbose"), args.found("resume")).run();
    return;
  }
  averagedFlow flow(mesh, averagedFlow::particles::none);
  timeStepControl timeStep(runTime);
  fieldWriter writer(runTime);
  flowProgress progress(runTime, flow, args.found("verbose"));
  eccentra::endOnArithmeticFault(
      "annulusFoam: error: the flow has blown up (a division by zero, an overflow or a value "
      "that is no number): reduce deltaT, or check the numbers of the boundary conditions\n");
  startFunctionObjects(runTime);
  while (runTime.run()) {
    timeStep.adjust(flow.CourantNo());
    ++runTime;
    progress.silence();
    flow.advance();
    progress.report();
    writer.write();
  }
  progress.summary();
  writer.finish();
}

} // namespace

int main(int argc, char* argv[]) {
  const eccentra::patientOutput output;
  eccentra::answerCommonOptions(argc, argv, "annulusFoam");
  eccentra::refuseUnusableCaseFolder(argc, argv);
  argList::addNote("Flow of a Herschel-Bulkley fluid in an annulus, alone or with particles");
  argList::noBanner();
  argList::addBoolOption("verbose", "print the residuals of every linear solve");
  argList::addBoolOption("resume", "go on from the newest complete checkpoint of a coupled run (docs/checkpoints.md)");
  eccentra::link::remember_command(argc, argv);
  const argList args(argc, argv);
  eccentra::endOnArithmeticFault("annulusFoam: error: a number that is read is out of range (a division by zero or an "
                                 "overflow): correct it in the dictionaries, the fields or their FoamFile headers\n");
  runReportingErrors("annulusFoam", [&] {
    run(args);
    if (eccentra::patientOutput::fails())
      throw inputError("the run has come to its end but standard output takes no messages: give them a "
                       "file or disk with room");
  });
  return 0;
}

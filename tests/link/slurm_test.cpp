// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The batch scripts of cases/slurm on a real Slurm: a job that is warned writes a checkpoint, and goes on when it is
// submitted again.
#include "coupled/checkpoint_scene.h"
#include "link/two_jobs.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

namespace {

using namespace eccentra::test;

/// In the case's folder: submit, warn once a checkpoint is there, submit again.
std::string job(const std::string& script) {
  const std::string file = required_environment("ECCENTRA_SOURCE") + "/cases/slurm/" + script;
  return "export PATH=" + required_environment("ECCENTRA_BIN") +
         ":$PATH SCRIPT=in.dem\n"
         "id=$(sbatch --parsable " +
         file +
         ") || exit 10\n"
         "for i in $(seq 300); do ls checkpoints/*/dem.restart >/dev/null 2>&1 && break; sleep 0.1; done\n"
         "scancel --batch --signal=USR1 $id\n"
         "for i in $(seq 200); do squeue -h -j $id 2>/dev/null | grep -q . || break; sleep 0.1; done\n"
         "grep -q 'SIGUSR1 asked to stop' log.* || exit 11\n"
         "sed -i 's/run 400000 upto/run 4000 upto/' in.dem\n"
         "sbatch --wait " +
         file +
         " || exit 12\n"
         "grep -q 'goes on from checkpoint' log.* || exit 13\n"
         "test -s end.bodies || exit 14\n";
}

void expect_job(BoxCase box, const std::string& name, const std::string& script) {
  // A first run of two ranks makes the case; it is then made long.
  const std::string steps = "run 400000 upto";
  box.script.replace(box.script.find(steps), steps.size(), "run 40 upto");
  box.coupling += " wait 0.01;";
  const std::string folder = run(box, name, 2).folder;
  replace_in(folder + "/in.dem", "run 40 upto", steps);
  replace_in(folder + "/constant/couplingProperties", " wait 0.01;", script == "socket.sbatch" ? " wait 60;" : "");
  for (const char* left : {"checkpoints", "end.bodies", "postProcessing"})
    std::filesystem::remove_all(folder + "/" + left);
  write_file(folder + "/job.sh", job(script));
  ProgramOptions options;
  options.directory = folder;
  options.timeout = 150;
  const ProgramResult result =
      run_program({required_environment("ECCENTRA_SOURCE") + "/scripts/slurm-one-node", "bash", "job.sh"}, options);
  EXPECT_EQ(result.status, 0) << result.output << contents(folder + "/log.slurm");
}

} // namespace

TEST(Slurm, LinkSolver) {
  expect_job(stirred_box("solver every 40 checkpoint 10", 400000, false), "slurm_solver", "solver.sbatch");
}

TEST(Slurm, LinkSocket) {
  const std::string address = socket_address("slurm");
  BoxCase box = stirred_box("socket " + address + " every 40 checkpoint 10 wait 60", 400000, false);
  box.coupling += "link socket; address \"" + address + "\";";
  expect_job(box, "slurm_socket", "socket.sbatch");
}

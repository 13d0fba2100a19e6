// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a turbulence model does to a run: nothing in a laminar one, refusals, restart, function objects.
#include "flow/caseFiles.H"
#include "flow/flowTurbulence.H"
#include "flow/turbulent_case.h"
#include "support/inputError.H"

#include <gtest/gtest.h>

#include <cstdlib>
#include <dlfcn.h>

namespace eccentra::test {
namespace {

constexpr double kDiameter = 0.1, kVelocity = 2;

void make(TurbulentCase& run) {
  run.half_channel(kDiameter / 4, 10);
  run.fluid({kVelocity * kDiameter / 4e4, 1}, kVelocity, kDiameter);
}

bool loaded(const char* library) {
  return dlopen(library, RTLD_LAZY | RTLD_NOLOAD) != nullptr;
}

/// The sentence of the refusal, or "".
template <class Work> std::string refusal(Work&& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

// First, as libraries stay loaded.
TEST(Laminar, LoadsNoModelAndHasNoField) {
  for (const char* properties : {"", "simulationType laminar;", "simulationType RAS; RAS { RASModel laminar; }"}) {
    TurbulentCase run("laminar", "kEpsilon");
    make(run);
    run.flow_case().dictionary("constant/turbulenceProperties", properties);
    if (!*properties) {
      std::remove((run.flow_case().folder() + "/constant/turbulenceProperties").c_str());
    }
    run.flow_case().advance(1);
    EXPECT_EQ(run.flow().turbulence(), nullptr) << properties;
    EXPECT_EQ(Foam::flowTurbulence::eddyViscosity(run.flow_case().mesh()), nullptr);
    EXPECT_TRUE(Foam::flowTurbulence::transported(run.flow_case().mesh()).empty());
  }
  EXPECT_FALSE(loaded("libeccentraTurbulence.so"));
  EXPECT_FALSE(loaded("libDPMTurbulenceModels.so"));
}

TEST(Refused, ModelsOutOfTheList) {
  for (const auto& [model, particles] : {std::pair<const char*, bool>{"LRR", false}, {"kOmega", true}, {"ke", false}}) {
    TurbulentCase run("refused", model);
    make(run);
    run.fraction(particles ? 0.8 : 1);
    const std::string text = refusal([&] { run.flow(); });
    EXPECT_NE(text.find("RASModel"), std::string::npos) << text;
    EXPECT_NE(text.find(model), std::string::npos) << text;
    EXPECT_NE(text.find("kEpsilon, realizableKE"), std::string::npos) << text;
    EXPECT_EQ(text.find("SpalartAllmaras") == std::string::npos, particles) << text;
  }
}

TEST(Refused, LargeEddiesAndOtherLaminarModels) {
  for (const char* properties : {"simulationType LES; LES { LESModel Smagorinsky; }",
                                 "simulationType laminar; laminar { laminarModel Maxwell; }"}) {
    TurbulentCase run("refused", "kEpsilon");
    make(run);
    run.flow_case().dictionary("constant/turbulenceProperties", properties);
    const std::string text = refusal([&] { Foam::checkCaseFiles(run.flow_case().time()); });
    EXPECT_NE(text.find("turbulenceProperties"), std::string::npos) << text;
    EXPECT_NE(text.find("laminar or RAS"), std::string::npos) << text;
  }
  TurbulentCase run("accepted", "kEpsilon");
  make(run);
  EXPECT_EQ(refusal([&] { Foam::checkCaseFiles(run.flow_case().time()); }), "");
}

/// All values that the next step depends on.
std::vector<double> state(TurbulentCase& run) {
  std::vector<double> values;
  forAll(run.flow().U(), celli) values.push_back(run.flow().U()[celli].x());
  for (const Foam::volScalarField* field : Foam::flowTurbulence::transported(run.flow_case().mesh()))
    values.insert(values.end(), field->begin(), field->end());
  const Foam::volScalarField& nut = *Foam::flowTurbulence::eddyViscosity(run.flow_case().mesh());
  values.insert(values.end(), nut.begin(), nut.end());
  return values;
}

TEST(Restart, ContinuesTheStraightRunBitForBit) {
  for (const char* model : {"kEpsilon", "kOmegaSST"}) {
    std::vector<double> found[2];
    for (const bool broken : {false, true}) {
      TurbulentCase run("restart", model, "backward");
      run.flow_case().control({{"deltaT", "0.01"}, {"endTime", "1"}});
      make(run);
      run.flow_case().advance(4);
      if (broken) {
        run.flow_case().time().writeNow();
        run.flow_case().reopen();
      }
      run.flow_case().advance(4);
      found[broken] = state(run);
    }
    ASSERT_EQ(found[0].size(), 40u); // U, two equations, nut of ten cells
    EXPECT_EQ(found[0], found[1]) << model;
  }
}

TEST(Run, FunctionObjectYPlusAndTheEndOfTheRun) {
  TurbulentCase run("yplus", "kEpsilon");
  make(run);
  run.flow_case().control(
      {{"deltaT", "1e4"},
       {"endTime", "3e6"},
       {"functions", "{ y { type yPlus; libs (\"libfieldFunctionObjects.so\"); writeControl timeStep; "
                     "writeInterval 300; } }"}});
  const Outcome outcome =
      run_program(run.flow_case().folder(), std::string(std::getenv("ECCENTRA_BIN")) + "/annulusFoam");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::string what = "turbulence by kEpsilon: y+ of the first cells is ";
  const std::size_t at = outcome.text.find(what);
  ASSERT_NE(at, std::string::npos) << outcome.text;
  EXPECT_EQ(outcome.text.find("without effect"), std::string::npos) << outcome.text;
  const double ours = std::atof(outcome.text.c_str() + at + what.size());
  // The function object writes time, patch, least, largest and mean y+ (from k, which the wall function relates to the
  // stress).
  const Outcome table = run_program(run.flow_case().folder(), "tail -n 1 postProcessing/y/0/yPlus.dat");
  double time = 0, least = 0;
  char patch[20];
  ASSERT_EQ(std::sscanf(table.text.c_str(), "%lf %19s %lf", &time, patch, &least), 3) << table.text;
  EXPECT_NEAR(ours, least, 0.05 * least);
}

} // namespace
} // namespace eccentra::test

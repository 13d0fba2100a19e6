// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// annulusFoam as a user calls it: Courant-bounded steps, progress, two ranks, errors.
#include "flow/flow_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace eccentra::test {
namespace {

std::string program() {
  return std::string(std::getenv("ECCENTRA_BIN")) + "/annulusFoam";
}

/// Number that follows the last occurrence of these arguments.
double last_after(const std::string& text, const std::string& arguments) {
  const size_t at = text.rfind(arguments);
  return at == std::string::npos ? NAN : std::atof(text.c_str() + at + arguments.size());
}

void section(FlowCase& flow_case) {
  flow_case.control({{"deltaT", "0.001"},
                     {"endTime", "0.12"},
                     {"adjustTimeStep", "yes"},
                     {"maxCo", "0.4"},
                     {"maxDeltaT", "0.02"},
                     {"progressInterval", "0"}});
  flow_case.annulus_mesh(0.5, 6, 24, 8, 0.1);
  flow_case.annulus_fields(0.5, 5.235988);
  flow_case.fluid("HerschelBulkleyCapped", 1000, "tau0 1; k 0.28; n 0.65; muY 100;");
  flow_case.drive("type meanVelocity; Ubar 0.58;");
}

TEST(AnnulusFoam, BoundsTheCourantNumberAndAgreesOnTwoRanks) {
  FlowCase flow_case("section");
  section(flow_case);
  const Outcome serial = run_program(flow_case.folder(), program());
  ASSERT_EQ(serial.exit_code, 0) << serial.text;
  // The step is chosen from the flow before it, which changes by little within one step.
  EXPECT_LT(last_after(serial.text, "  Co "), 0.45) << serial.text;
  EXPECT_GT(last_after(serial.text, "  dt "), 0.001) << "the step must grow from its first value";
  EXPECT_NEAR(last_after(serial.text, "<alpha U> "), 0.58, 1e-5);
  EXPECT_NE(serial.text.find("left "), std::string::npos);

  flow_case.dictionary("system/decomposeParDict",
                       "numberOfSubdomains 2; method simple; simpleCoeffs { n (1 1 2); delta 0.001; }");
  const Outcome parallel = run_program(
      flow_case.folder(), "decomposePar > decompose.log && mpirun --oversubscribe -np 2 " + program() + " -parallel");
  ASSERT_EQ(parallel.exit_code, 0) << parallel.text;
  const double G = last_after(serial.text, "  G ");
  EXPECT_GT(G, 100);
  EXPECT_NEAR(last_after(parallel.text, "  G "), G, 1e-3 * G);
}

TEST(AnnulusFoam, RefusesWithOneSentence) {
  const struct {
    std::string file, body, expected;
  } bad[] = {{"constant/flowProperties", "drive { type meanvelocity; Ubar 1; }", "meanVelocity"},
             {"constant/flowProperties", "drive { type meanVelocity; }", "Ubar"},
             {"constant/flowProperties", "drive { type meanVelocity; Ubar 1; direction (1 1 0); }", "direction"},
             {"constant/transportProperties", "transportModel Newtonian; nu 1e-4;", "rho"},
             {"constant/transportProperties", "transportModel Newtonian; nu 1e-4; rho -1;", "rho"},
             {"constant/transportProperties", "transportModel Newtonian; nu 1e-4; rho 1000; faceViscosity x;",
              "faceViscosity"}};
  FlowCase flow_case("refusing");
  for (const auto& b : bad) {
    section(flow_case);
    flow_case.dictionary(b.file, b.body);
    const Outcome outcome = run_program(flow_case.folder(), program());
    EXPECT_EQ(outcome.exit_code, 1) << b.body << outcome.text;
    const size_t at = outcome.text.find("annulusFoam: error: ");
    ASSERT_NE(at, std::string::npos) << b.body << outcome.text;
    const std::string sentence = outcome.text.substr(at);
    EXPECT_NE(sentence.find(b.expected), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), sentence.size() - 1) << sentence;
  }
}

} // namespace
} // namespace eccentra::test

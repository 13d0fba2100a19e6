// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity of both Herschel-Bulkley laws: as functions, as models on a mesh, and selected by stock pimpleFoam.
#include "flow/flow_case.h"
#include "rheology/herschel_bulkley.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace eccentra::test {
namespace {

using rheology::HerschelBulkley;

const HerschelBulkley kMud{1, 0.28, 0.65, 100};
constexpr double kTolerance = 1e-9;

struct Reference {
  double rate, regularised, capped;
};
// Computed in high precision.
const Reference kReferences[] = {{.005, 100, 100},
                                 {.01, 100, 100},
                                 {.02, 50.3993637669, 51.101025894},
                                 {1, 1.26596675746, 1.28},
                                 {10, .223668081548, .225071405802},
                                 {100, .0657270123937, .0658673448191}};

TEST(HerschelBulkleyLaw, ReferenceValues) {
  for (const Reference& r : kReferences) {
    EXPECT_NEAR(rheology::regularised_viscosity(kMud, r.rate), r.regularised, kTolerance * r.regularised) << r.rate;
    EXPECT_NEAR(rheology::capped_viscosity(kMud, r.rate), r.capped, kTolerance * r.capped) << r.rate;
  }
}

TEST(HerschelBulkleyLaw, LimitsAreFinite) {
  for (const double tau0 : {0.0, 1e-9, 1.0}) {
    for (const double n : {0.3, 0.65, 1.0}) {
      const HerschelBulkley fluid{tau0, 0.28, n, 100};
      for (const double rate : {0.0, 1e-300, 1e-12, 1e-3}) {
        for (const double mu :
             {rheology::regularised_viscosity(fluid, rate), rheology::capped_viscosity(fluid, rate)}) {
          EXPECT_TRUE(std::isfinite(mu) && mu > 0 && mu <= 100) << tau0 << " " << n << " " << rate << " " << mu;
        }
      }
    }
  }
  const HerschelBulkley newtonian{0, 0.1, 1, 100};
  EXPECT_DOUBLE_EQ(rheology::regularised_viscosity(newtonian, 3), 0.1);
  EXPECT_DOUBLE_EQ(rheology::capped_viscosity(newtonian, 3), 0.1);
  // Eq 4 is continuous where it starts to yield.
  EXPECT_NEAR(rheology::regularised_viscosity(kMud, 0.01 * (1 + 1e-10)), 100, 1e-6);
}

/// Channel between moving walls: u = rate y, which the linear gradient reproduces exactly.
void couette(FlowCase& flow_case, const std::string& model, double rate) {
  const double gap = 0.1;
  flow_case.channel_mesh(gap, 2, 10);
  std::ostringstream U, boundary;
  U.precision(17);
  U << "nonuniform List<vector> 20(";
  for (int j = 0; j < 10; ++j) {
    U << "(" << rate * gap * (j + 0.5) / 10 << " 0 0) (" << rate * gap * (j + 0.5) / 10 << " 0 0) ";
  }
  U << ")";
  boundary.precision(17);
  // Both walls are one patch of 4 faces, the lower two first.
  boundary << "inlet { type cyclic; } outlet { type cyclic; } sides { type empty; } walls { type fixedValue; value "
           << "nonuniform List<vector> 4((0 0 0) (0 0 0) (" << rate * gap << " 0 0) (" << rate * gap << " 0 0)); }";
  flow_case.fields(U.str(), boundary.str(),
                   "inlet { type cyclic; } outlet { type cyclic; } sides { type empty; } walls { type zeroGradient; }");
  flow_case.fluid(model, 1250, "tau0 1; k 0.28; n 0.65; muY 100;");
}

TEST(HerschelBulkleyModel, LocalValuesOnAMesh) {
  for (const Reference& r : kReferences) {
    for (const std::string model : {"Regularised", "Capped"}) {
      FlowCase flow_case("couette_" + model);
      couette(flow_case, "HerschelBulkley" + model, r.rate);
      const double expected = (model == "Capped" ? r.capped : r.regularised) / 1250;
      const auto nu = flow_case.flow().rheology().nu();
      for (const double value : nu().primitiveField()) {
        EXPECT_NEAR(value, expected, kTolerance * expected) << model << " at " << r.rate;
      }
    }
  }
}

TEST(HerschelBulkleyModel, StockPimpleFoamSelectsIt) {
  for (const std::string model : {"HerschelBulkleyRegularised", "HerschelBulkleyCapped"}) {
    FlowCase flow_case("stock_" + model);
    flow_case.control({{"libs", "(\"libeccentraRheology.so\")"},
                       {"deltaT", "1e-3"},
                       {"endTime", "2e-3"},
                       {"writeInterval", "2"},
                       {"writeFormat", "ascii"}});
    flow_case.numerics("Euler", "nCorrectors 1; pRefCell 0; pRefValue 0;");
    couette(flow_case, model, 10);
    flow_case.dictionary("constant/turbulenceProperties", "simulationType laminar;\n");
    const Outcome outcome = run_program(flow_case.folder(), stock_solver("pimpleFoam") + " && cat 0.002/nu");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
    const size_t at = outcome.text.find("internalField");
    ASSERT_NE(at, std::string::npos);
    // The exact flow is steady, so the field stays the one of the law.
    const double expected = (model == "HerschelBulkleyCapped" ? .225071405802 : .223668081548) / 1250;
    std::istringstream values(outcome.text.substr(at));
    std::string word;
    values >> word >> word;
    double value = 0;
    if (word == "uniform") {
      values >> value;
    } else {
      values.ignore(1000, '(');
      values >> value;
    }
    EXPECT_NEAR(value, expected, kTolerance * expected);
  }
}

TEST(HerschelBulkleyModel, RefusesWhatIsUnphysical) {
  const struct {
    const char *coefficients, *keyword;
  } bad[] = {{"tau0 -1; k 0.28; n 0.65; muY 100;", "tau0"},
             {"tau0 1; k 0; n 0.65; muY 100;", "k"},
             {"tau0 1; k 0.28; n 0; muY 100;", "n"},
             {"tau0 1; k 0.28; n 0.65; muY -5;", "muY"},
             {"tau0 1; k 0.28; n 0.65;", "muY"},
             {"tau0 1; k 0.28; n 0.65; muY 100; relaxation 2;", "relaxation"}};
  for (const auto& b : bad) {
    FlowCase flow_case("refused");
    couette(flow_case, "HerschelBulkleyCapped", 1);
    flow_case.fluid("HerschelBulkleyCapped", 1250, b.coefficients);
    const Outcome outcome = run_program(flow_case.folder(), std::string(std::getenv("ECCENTRA_BIN")) + "/annulusFoam");
    EXPECT_NE(outcome.exit_code, 0) << b.coefficients;
    EXPECT_NE(outcome.text.find("annulusFoam: error:"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(b.keyword), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("transportProperties"), std::string::npos) << outcome.text;
  }
}

} // namespace
} // namespace eccentra::test

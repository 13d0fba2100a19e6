// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes cases with a turbulence model, and the laws that their friction is compared with.
#include "flow/turbulent_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace eccentra::test {

namespace {

/// Scales of the first guess.
constexpr double kIntensity = 0.05, kMixing = 0.07, kCmu = 0.09;
constexpr double kHalfWedge = 2.5 * M_PI / 180;

std::string number(double value) {
  std::ostringstream text;
  text.precision(15);
  text << value;
  return text.str();
}

double root_of(double (*excess)(double, double, double), double Reynolds, double n) {
  double low = 1e-5, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(low * high);
    (excess(middle, Reynolds, n) > 0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

} // namespace

double friction(double gradient, double diameter, double velocity) {
  return gradient * diameter / (2 * velocity * velocity);
}

double dodge_metzner(double Reynolds, double n) {
  return root_of(
      [](double f, double Re, double index) {
        return 1 / std::sqrt(f) - 4 / std::pow(index, 0.75) * std::log10(Re * std::pow(f, 1 - index / 2)) +
               0.4 / std::pow(index, 1.2);
      },
      Reynolds, n);
}

double prandtl(double Reynolds) {
  return dodge_metzner(Reynolds, 1);
}

TurbulentCase::TurbulentCase(const std::string& name, const std::string& model, const std::string& ddt)
    : case_(name), model_(model) {
  case_.control({{"deltaT", "1e4"}, {"endTime", "1e9"}});
  numerics(ddt);
  case_.dictionary("constant/turbulenceProperties",
                   "simulationType RAS;\nRAS { RASModel " + model + "; turbulence on; printCoeffs off; }\n");
}

void TurbulentCase::numerics(const std::string& ddt) {
  case_.dictionary(
      "system/fvSchemes",
      "ddtSchemes { default " + ddt +
          "; }\n"
          "gradSchemes { default Gauss linear; }\n"
          "divSchemes { default none; div(phi,U) Gauss linear; div((nuEff*dev2(T(grad(U))))) Gauss linear;\n"
          "\"div\\((phi|alphaPhi),(k|epsilon|omega)\\)\" Gauss upwind; }\n"
          "laplacianSchemes { default Gauss linear corrected; }\n"
          "interpolationSchemes { default linear; }\n"
          "snGradSchemes { default corrected; }\n"
          "wallDist { method meshWave; }\n");
  case_.dictionary(
      "system/fvSolution",
      "solvers {\n"
      "\"p|pFinal\" { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; maxIter 1000; }\n"
      "\"(U|k|epsilon|omega)(Final)?\" { solver PBiCGStab; preconditioner DILU; tolerance 1e-13; relTol 0; "
      "maxIter 1000; }\n"
      "}\nPIMPLE { nCorrectors 1; consistent yes; }\n"
      "relaxationFactors { equations { \"U.*\" 0.9; \"(k|epsilon|omega).*\" 0.8; } }\n");
}

void TurbulentCase::mesh(const std::string& body) {
  case_.dictionary("system/blockMeshDict", "scale 1;\n" + body);
  const Outcome outcome = run_program(case_.folder(), "blockMesh");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
}

void TurbulentCase::half_channel(double half_gap, int cells) {
  const std::string h = number(half_gap);
  mesh("vertices ((0 0 0) (" + h + " 0 0) (" + h + " " + h + " 0) (0 " + h + " 0) (0 0 " + h + ") (" + h + " 0 " + h +
       ") (" + h + " " + h + " " + h + ") (0 " + h + " " + h + "));\nblocks (hex (0 1 2 3 4 5 6 7) (1 " +
       std::to_string(cells) +
       " 1) simpleGrading (1 1 1));\nboundary (\n"
       "inlet { type cyclic; neighbourPatch outlet; faces ((0 4 7 3)); }\n"
       "outlet { type cyclic; neighbourPatch inlet; faces ((1 2 6 5)); }\n"
       "wall { type wall; faces ((0 1 5 4)); } middle { type symmetryPlane; faces ((3 7 6 2)); }\n"
       "sides { type empty; faces ((0 3 2 1) (4 5 6 7)); } );\n");
}

void TurbulentCase::wedge(double inner, double outer, int cells) {
  const std::string length = number(outer);
  const auto at = [](const std::string& x, double radius, int side) {
    return "(" + x + " " + number(radius * std::cos(kHalfWedge)) + " " + number(side * radius * std::sin(kHalfWedge)) +
           ") ";
  };
  const bool pipe = !(inner > 0);
  std::string text = "vertices (";
  for (const int side : {-1, 1}) {
    text += at("0", inner, side) + at(length, inner, side) + at(length, outer, side) + at("0", outer, side);
  }
  // On the axis both sides have one edge.
  const std::string hex = pipe ? "(0 1 2 3 0 1 6 7)" : "(0 1 2 3 4 5 6 7)";
  const std::string front = pipe ? "(0 1 6 7)" : "(4 5 6 7)";
  const std::string low = pipe ? "(0 0 7 3)" : "(0 4 7 3)", high = pipe ? "(1 2 6 1)" : "(1 2 6 5)";
  text += ");\nblocks (hex " + hex + " (1 " + std::to_string(cells) +
          " 1) simpleGrading (1 1 1));\nboundary (\n"
          "inlet { type cyclic; neighbourPatch outlet; faces (" +
          low + "); }\noutlet { type cyclic; neighbourPatch inlet; faces (" + high +
          "); }\n"
          "wall { type wall; faces ((3 7 6 2)); } back { type wedge; faces ((0 3 2 1)); } front { type wedge; faces (" +
          front + "); }\n";
  text += pipe ? "axis { type empty; faces ((0 1 1 0)); } );\n" : "inner { type wall; faces ((0 1 5 4)); } );\n";
  mesh(text);
}

void TurbulentCase::annulus(double eccentricity, int radial, int around) {
  along_ = "(0 0 1)";
  case_.annulus_mesh(eccentricity, radial, around, 1, 0.01);
}

void TurbulentCase::fluid(const PowerLaw& law, double velocity, double diameter) {
  if (law.n == 1) {
    case_.newtonian(1000, 1000 * law.k);
  } else {
    case_.fluid("HerschelBulkleyCapped", 1000,
                "tau0 0; k " + number(1000 * law.k) + "; n " + number(law.n) + "; muY 100;");
  }
  case_.drive("type meanVelocity; direction " + along_ + "; Ubar " + number(velocity) + ";");
  const double k = 1.5 * std::pow(kIntensity * velocity, 2);
  const double epsilon = std::pow(kCmu, 0.75) * std::pow(k, 1.5) / (kMixing * diameter);
  const std::string sides =
      "inlet { type cyclic; } outlet { type cyclic; } middle { type symmetryPlane; } sides { type "
      "empty; } axis { type empty; } back { type wedge; } front { type wedge; } ";
  const std::string walls = "\"wall|inner|pipe|hole\" ";
  const std::string u =
      along_ == "(0 0 1)" ? "uniform (0 0 " + number(velocity) + ")" : "uniform (" + number(velocity) + " 0 0)";
  case_.fields(u, sides + walls + "{ type noSlip; }", sides + walls + "{ type zeroGradient; }");
  const auto scalar_field = [&](const std::string& name, const std::string& dimensions, double value,
                                const std::string& at_walls) {
    case_.write("0/" + name, "volScalarField",
                "dimensions " + dimensions + ";\ninternalField uniform " + number(value) + ";\nboundaryField { " +
                    sides + walls + "{ type " + at_walls + "; value uniform " + number(value) + "; } }\n");
  };
  scalar_field("k", "[0 2 -2 0 0 0 0]", k, "kqRWallFunction");
  scalar_field("epsilon", "[0 2 -3 0 0 0 0]", epsilon, "epsilonWallFunction");
  scalar_field("omega", "[0 0 -1 0 0 0 0]", epsilon / (kCmu * k), "omegaWallFunction");
  scalar_field("nut", "[0 2 -1 0 0 0 0]", kCmu * k * k / epsilon, "nutkWallFunction");
}

void TurbulentCase::fraction(double alpha) {
  alpha_ = alpha;
}

Foam::averagedFlow& TurbulentCase::flow() {
  using Foam::averagedFlow;
  if (alpha_ == 1) {
    return case_.flow();
  }
  averagedFlow& flow = case_.flow(averagedFlow::particles::coupled, averagedFlow::stressShare::fraction);
  if (flow.alpha()[0] != alpha_) {
    flow.alpha() == Foam::dimensionedScalar("alpha", Foam::dimless, alpha_);
    flow.resetFractionHistory();
  }
  return flow;
}

double TurbulentCase::gradient() {
  flow();
  return case_.steady([&] { return flow().drivingPressureGradient(); }, 1e-6, 4000) / flow().rho();
}

} // namespace eccentra::test

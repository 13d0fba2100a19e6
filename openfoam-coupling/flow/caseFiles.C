// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The tables, from the dictionaries that the applications and libraries of OpenFOAM v1912 read, and the walk over a
// case.
#include "flow/caseFiles.H"

#include "support/inputError.H"

#include "IFstream.H"
#include "OSspecific.H"
#include "volFields.H"

#include <algorithm>
#include <iostream>
#include <set>

namespace Foam {

namespace {

/// True where every sub-dictionary, or the dictionary itself, says `active no`.
bool inactive(const dictionary& dict) {
  if (dict.found("active")) {
    return !dict.get<Switch>("active");
  }
  for (const entry& e : dict) {
    if (e.isDict() && e.keyword() != "FoamFile" && e.dict().getOrDefault<Switch>("active", true)) {
      return false;
    }
  }
  return true;
}

/// True where this entry is there and is one of these arguments.
bool says(const dictionary& dict, const char* keyword, std::initializer_list<const char*> arguments) {
  word value;
  return dict.readIfPresent(keyword, value) &&
         std::any_of(arguments.begin(), arguments.end(), [&](const char* w) { return value == w; });
}

bool noTurbulence(const dictionary& dict) {
  if (says(dict, "simulationType", {"laminar"})) {
    const dictionary& laminar = dict.subOrEmptyDict("laminar");
    return !laminar.found("laminarModel") || says(laminar, "laminarModel", {"Stokes", "laminar"});
  }
  return says(dict, "simulationType", {"RAS"}) && (says(dict.subOrEmptyDict("RAS"), "RASModel", {"laminar"}) ||
                                                   says(dict.subOrEmptyDict("RAS"), "model", {"laminar"}));
}

bool knownTurbulence(const dictionary& dict) {
  return says(dict, "simulationType", {"RAS"}) || noTurbulence(dict);
}

bool staticMesh(const dictionary& dict) {
  return says(dict, "dynamicFvMesh", {"staticFvMesh"});
}
bool noRadiation(const dictionary& dict) {
  return says(dict, "radiationModel", {"none"}) || (dict.found("radiation") && !dict.get<Switch>("radiation"));
}
bool noCombustion(const dictionary& dict) {
  return says(dict, "combustionModel", {"none", "noCombustion"}) || (dict.found("active") && inactive(dict));
}
bool noChemistry(const dictionary& dict) {
  return dict.found("chemistry") && !dict.get<Switch>("chemistry");
}
bool noFilm(const dictionary& dict) {
  return says(dict, "surfaceFilmModel", {"none"});
}
bool noPyrolysis(const dictionary& dict) {
  return dict.found("active") && inactive(dict);
}
bool noCloud(const dictionary& dict) {
  const dictionary& solution = dict.subOrEmptyDict("solution");
  return solution.found("active") && !solution.get<Switch>("active");
}

const char* const kOneFluid = "the flow is of one incompressible fluid of constant temperature, which "
                              "constant/transportProperties describes; remove the file, or use a solver of OpenFOAM "
                              "that reads it";
const char* const kParticles = "particles come from a LIGGGHTS script, which constant/couplingProperties names; "
                               "remove the file";

} // namespace

const std::vector<caseFile>& caseFiles() {
  using v = verdict;
  static const std::vector<caseFile> table{
      // Read here.
      {"transportProperties", v::acts, nullptr, ""},
      {"flowProperties", v::acts, nullptr, ""},
      {"couplingProperties", v::acts, nullptr, ""},
      {"g", v::acts, nullptr, ""},
      {"polyMesh", v::acts, nullptr, ""},
      {"boundaryData", v::acts, nullptr, ""},
      {"controlDict", v::acts, nullptr, ""},
      {"fvSchemes", v::acts, nullptr, ""},
      {"fvSolution", v::acts, nullptr, ""},
      // The flow would be another one.
      {"fvOptions", v::refused, inactive,
       "there are no fvOptions here; drive a periodic section by constant/flowProperties { drive { type meanVelocity; "
       "Ubar 0.58; } }, remove the file or give its entries active no"},
      {"MRFProperties", v::refused, inactive,
       "there are no rotating frames here; turn the pipe by the boundary condition rotatingWallVelocity in 0/U, and "
       "remove the file or give its zones active no"},
      {"SRFProperties", v::refused, nullptr,
       "there are no rotating frames here; turn the pipe by the boundary condition rotatingWallVelocity in 0/U, and "
       "remove the file"},
      {"turbulenceProperties", v::refused, knownTurbulence,
       "give simulationType laminar or RAS; for LES, which needs a finer mesh than an annulus with particles has, use "
       "pimpleFoam with libs (\"libeccentraRheology.so\")"},
      {"turbulenceProperties.*", v::refused, noTurbulence,
       "there is one fluid here; give constant/turbulenceProperties"},
      {"dynamicMeshDict", v::refused, staticMesh,
       "the mesh does not move; give dynamicFvMesh staticFvMesh or remove the file, and turn the pipe by "
       "rotatingWallVelocity in 0/U"},
      {"motionSolverDict", v::refused, nullptr, "the mesh does not move; remove the file"},
      {"porosityProperties", v::refused, inactive,
       "there are no porous zones here; remove the file or give its zones active no"},
      {"thermophysicalProperties", v::refused, nullptr, kOneFluid},
      {"thermodynamicProperties", v::refused, nullptr, kOneFluid},
      {"radiationProperties", v::refused, noRadiation, kOneFluid},
      {"combustionProperties", v::refused, noCombustion, kOneFluid},
      {"chemistryProperties", v::refused, noChemistry, kOneFluid},
      {"phaseProperties", v::refused, nullptr, kOneFluid},
      {"phaseChangeProperties", v::refused, nullptr, kOneFluid},
      {"surfaceFilmProperties", v::refused, noFilm, kOneFluid},
      {"pyrolysisZones", v::refused, noPyrolysis, kOneFluid},
      {"thermalBaffleProperties", v::refused, nullptr, kOneFluid},
      {"regionProperties", v::refused, nullptr, "there is one region here; remove the file"},
      {"PDRProperties", v::refused, nullptr, kOneFluid},
      {"waveProperties", v::refused, nullptr, "there is no free surface here; remove the file"},
      {"*CloudProperties", v::refused, noCloud, kParticles},
      {"*Cloud1Properties", v::refused, noCloud, kParticles},
      {"coalCloudList", v::refused, nullptr, kParticles},
      {"dsmcProperties", v::refused, nullptr, kParticles},
      {"moleculeProperties", v::refused, nullptr, kParticles},
      {"parcelInjectionProperties", v::refused, nullptr, kParticles},
      // Without effect on this flow.
      {"RASProperties", v::noted, nullptr, "v1912 reads constant/turbulenceProperties in its place"},
      {"LESProperties", v::noted, nullptr, "v1912 reads constant/turbulenceProperties in its place"},
      {"momentumTransport", v::noted, nullptr, "constant/turbulenceProperties is read in its place"},
      {"adjointRASProperties", v::noted, nullptr, ""},
      {"optimisationDict", v::noted, nullptr, ""},
      {"fvOptionsAdjoint", v::noted, nullptr, ""},
      {"boundaryRadiationProperties", v::noted, nullptr, ""},
      {"viewFactorsDict", v::noted, nullptr, ""},
      {"additionalControls", v::noted, nullptr, ""},
      {"gravitationalProperties", v::noted, nullptr, ""},
      {"hRef", v::noted, nullptr, ""},
      {"pRef", v::noted, nullptr, ""},
      {"reactions*", v::noted, nullptr, ""},
      {"thermo.*", v::noted, nullptr, ""},
      {"foam.*", v::noted, nullptr, ""},
      {"liquidProperties", v::noted, nullptr, ""},
      {"solidProperties", v::noted, nullptr, ""},
      {"thermalProperties", v::noted, nullptr, ""},
      {"mechanicalProperties", v::noted, nullptr, ""},
      {"physicalProperties", v::noted, nullptr, ""},
      {"electromagneticProperties", v::noted, nullptr, ""},
      {"financialProperties", v::noted, nullptr, ""},
      {"engineGeometry", v::noted, nullptr, ""},
      {"motionProperties", v::noted, nullptr, ""},
      {"particleTrackProperties", v::noted, nullptr, ""},
      {"faMeshDefinition", v::noted, nullptr, ""},
      {"faSchemes", v::noted, nullptr, ""},
      {"faSolution", v::noted, nullptr, ""},
      {"caseProperties", v::noted, nullptr, ""},
      {"reducedUnitsDict", v::noted, nullptr, ""},
      {"mdTransportProperitesDict", v::noted, nullptr, ""},
      {"saturationModel", v::noted, nullptr, ""},
      // Geometry and tools.
      {"triSurface", v::harmless, nullptr, ""},
      {"geometry", v::harmless, nullptr, ""},
      {"extendedFeatureEdgeMesh", v::harmless, nullptr, ""},
      {"cellToRegion", v::harmless, nullptr, ""},
      {"README*", v::harmless, nullptr, ""},
      {"*Dict", v::harmless, nullptr, ""},
      {"*Dict.*", v::harmless, nullptr, ""},
  };
  return table;
}

const std::vector<caseType>& boundaryTypes() {
  using v = verdict;
  static const char* const hydrostatic =
      "p is p_rgh over the density, without the weight of the fluid; give fixedValue, "
      "totalPressure or zeroGradient";
  static const char* const heat = "it needs a compressible fluid; give fixedValue, inletOutlet or zeroGradient";
  static const char* const phases = "it needs several fluids; give fixedValue, flowRateInletVelocity or, beside "
                                    "particles, interstitialInletVelocity";
  static const char* const frames = "there are no rotating frames here; give rotatingWallVelocity or fixedValue";
  static const std::vector<caseType> table{{"prghPressure", v::refused, hydrostatic},
                                           {"prghTotalPressure", v::refused, hydrostatic},
                                           {"prghTotalHydrostaticPressure", v::refused, hydrostatic},
                                           {"phaseHydrostaticPressure", v::refused, hydrostatic},
                                           {"uniformDensityHydrostaticPressure", v::refused, hydrostatic},
                                           {"waveSurfacePressure", v::refused, hydrostatic},
                                           {"plenumPressure", v::refused, heat},
                                           {"waveTransmissive", v::refused, heat},
                                           {"supersonicFreestream", v::refused, heat},
                                           {"fixedPressureCompressibleDensity", v::refused, heat},
                                           {"variableHeightFlowRate", v::refused, phases},
                                           {"variableHeightFlowRateInletVelocity", v::refused, phases},
                                           {"outletPhaseMeanVelocity", v::refused, phases},
                                           {"SRFVelocity", v::refused, frames},
                                           {"SRFFreestreamVelocity", v::refused, frames},
                                           {"SRFWallVelocity", v::refused, frames}};
  return table;
}

const std::vector<caseType>& functionObjectTypes() {
  using v = verdict;
  static const char* const heat = "there is no temperature here";
  static const char* const turbulence = "there is no turbulence of that kind here";
  static const char* const cloud = "there is no cloud of OpenFOAM's here: LIGGGHTS has the particles";
  static const std::vector<caseType> table{{"wallHeatFlux", v::noted, heat},
                                           {"heatTransferCoeff", v::noted, heat},
                                           {"energyTransport", v::noted, heat},
                                           {"externalCoupled", v::noted, heat},
                                           {"MachNo", v::noted, heat},
                                           {"thermoCoupleProbes", v::noted, heat},
                                           {"psiReactionsSensitivityAnalysis", v::noted, heat},
                                           {"rhoReactionsSensitivityAnalysis", v::noted, heat},
                                           {"XiReactionRate", v::noted, heat},

                                           {"psiReactionThermoMoleFractions", v::noted, heat},
                                           {"rhoReactionThermoMoleFractions", v::noted, heat},
                                           {"psiSpecieReactionRates", v::noted, heat},
                                           {"rhoSpecieReactionRates", v::noted, heat},

                                           {"turbulenceFields", v::noted, turbulence},
                                           {"DESModelRegions", v::noted, turbulence},
                                           {"proudmanAcousticPower", v::noted, turbulence},
                                           {"cloudInfo", v::noted, cloud},
                                           {"dsmcFields", v::noted, cloud},
                                           {"particleDistribution", v::noted, cloud},
                                           {"vtkCloud", v::noted, cloud},
                                           {"dataCloud", v::noted, cloud},
                                           {"icoUncoupledKinematicCloud", v::noted, cloud},
                                           {"hydrostaticPressure", v::noted, "p is p_rgh over the density already"},
                                           {"interfaceHeight", v::noted, "there is one fluid"},
                                           {"sizeDistribution", v::noted, "there is one fluid"},
                                           {"phaseForces", v::noted, "there is one fluid"},
                                           {"phaseMap", v::noted, "there is one fluid"}};
  return table;
}

void note(const std::string& sentence) {
  if (Pstream::master()) {
    std::cout << "annulusFoam: note: " << sentence << std::endl;
  }
}

namespace {

/// A name of the table: exact, or with a * at one end.
bool matches(const std::string& pattern, const std::string& name) {
  const std::string::size_type star = pattern.find('*');
  if (star == std::string::npos) {
    return pattern == name;
  }
  const std::string before = pattern.substr(0, star), after = pattern.substr(star + 1);
  return name.size() >= before.size() + after.size() && name.compare(0, before.size(), before) == 0 &&
         name.compare(name.size() - after.size(), after.size(), after) == 0;
}

const caseFile* known(const std::string& name) {
  for (const caseFile& file : caseFiles()) {
    if (matches(file.name, name)) {
      return &file;
    }
  }
  return nullptr;
}

/// A stock solver reads turbulenceProperties.water for a phase named water.
const caseFile* knownOfAnyPhase(const std::string& name) {
  const caseFile* file = known(name);
  if (!file && name.find('.') != std::string::npos) {
    file = known(name.substr(0, name.find('.')));
    if (file && file->decision == verdict::acts) {
      return nullptr;
    }
  }
  return file;
}

/// Copies that no program reads.
bool aside(const std::string& name) {
  for (const char* pattern : {"*~", "*.orig", "*.org", "*.bak", "*.old", "*.template", "*.tmp", "*.m4", "#*", ".*"}) {
    if (matches(pattern, name)) {
      return true;
    }
  }
  return false;
}

/// Files and folders of a folder of the case, in order; a compressed file by the name that it is read by.
std::set<std::string> namesIn(const fileName& folder) {
  std::set<std::string> names;
  for (const fileName::Type type : {fileName::FILE, fileName::DIRECTORY}) {
    for (const fileName& name : readDir(folder, type, false)) {
      names.insert(name.hasExt("gz") ? std::string(name.lessExt()) : std::string(name));
    }
  }
  return names;
}

void join(std::string& list, const std::string& item) {
  list += (list.empty() ? "" : ", ") + item;
}

void checkFolder(const Time& time, const fileName& folder, bool all, std::string& unread) {
  for (const std::string& name : namesIn(time.globalPath() / folder)) {
    const std::string path = folder + "/" + name;
    const caseFile* const file = aside(name) ? nullptr : knownOfAnyPhase(name);
    if (!file) {
      if (all && !aside(name)) {
        join(unread, path);
      }
    } else if (file->decision == verdict::noted) {
      join(unread, path + (*file->remedy ? std::string(" (") + file->remedy + ")" : ""));
    } else if (file->decision == verdict::refused) {
      const bool inert = file->inert && [&] {
        IFstream is(time.globalPath() / path);
        dictionary content(is);
        content.remove("FoamFile");
        return file->inert(content);
      }();
      if (!inert) {
        throw inputError(
            path + ": annulusFoam does not use it and the flow would not be the one it describes: " + file->remedy);
      }
    }
  }
}

/// Fields of the turbulence models that can be chosen.
bool turbulenceField(const std::string& name) {
  static const std::set<std::string> fields{"k",  "epsilon", "omega", "nut",      "nuTilda",
                                            "v2", "f",       "phit",  "gammaInt", "ReThetat"};
  return fields.count(name);
}

/// Fields that solvers of OpenFOAM read beside U and p.
bool solverField(const std::string& name) {
  static const std::set<std::string> fields{"nuSgs",
                                            "muSgs",
                                            "mut",
                                            "alphat",
                                            "kl",
                                            "kt",
                                            "zeta",
                                            "R",
                                            "T",
                                            "p_rgh",
                                            "h",
                                            "e",
                                            "rho",
                                            "Urel",
                                            "G",
                                            "Ydefault",
                                            "B",
                                            "Theta",
                                            "cellDisplacement",
                                            "pointDisplacement",
                                            "pointMotionU",
                                            "cellMotionU",
                                            "IDefault",
                                            "dpdt",
                                            "Su",
                                            "b",
                                            "Xi"};
  const std::string::size_type dot = name.find('.');
  return fields.count(name) ||
         (dot != std::string::npos && (fields.count(name.substr(0, dot)) || matches("U.*", name) ||
                                       matches("p.*", name) || matches("alpha.*", name)));
}

void checkFields(const Time& time, std::string& unread) {
  for (const std::string& name : namesIn(time.path() / time.timeName())) {
    if (turbulenceField(name) ? !turbulent(time) : solverField(name)) {
      join(unread, time.timeName() + "/" + name);
    }
  }
}

void checkFunctionObjects(const Time& time, std::string& unread) {
  const dictionary* const functions = time.controlDict().findDict("functions");
  if (!functions) {
    return;
  }
  for (const entry& e : *functions) {
    if (!e.isDict() || !e.dict().getOrDefault<Switch>("enabled", true)) {
      continue;
    }
    const word type(e.dict().getOrDefault<word>("type", word::null));
    for (const caseType& known : functionObjectTypes()) {
      if (type == known.name && !(type == "turbulenceFields" && turbulent(time))) {
        join(unread, "functions/" + e.keyword() + " of system/controlDict (" + type + ": " + known.remedy + ")");
      }
    }
  }
}

} // namespace

void checkCaseFiles(const Time& time) {
  std::string unread;
  checkFolder(time, time.constant(), true, unread);
  // Of system/ much belongs to tools: only what a solver reads counts.
  checkFolder(time, time.system(), false, unread);
  checkFields(time, unread);
  checkFunctionObjects(time, unread);
  if (!unread.empty()) {
    note("without effect on this flow unless a file that annulusFoam reads includes them: " + unread);
  }
}

bool turbulent(const Time& time) {
  const fileName path(time.globalPath() / time.constant() / "turbulenceProperties");
  if (!isFile(path)) {
    return false;
  }
  IFstream is(path);
  const dictionary content(is);
  return knownTurbulence(content) && !noTurbulence(content);
}

void checkSolutionControls(const dictionary& fvSolution, bool turbulent) {
  std::string unread;
  const bool own = fvSolution.found("PIMPLE");
  for (const char* other : {"PISO", "SIMPLE"}) {
    if (fvSolution.found(other) && !own) {
      throw inputError(std::string(fvSolution.name()) + ": " + other +
                       " is not read, and PIMPLE, which annulusFoam reads, is not there: name the dictionary PIMPLE");
    }
    if (fvSolution.found(other)) {
      join(unread, std::string(other) + " (PIMPLE is read)");
    }
  }
  const dictionary& pimple = fvSolution.subOrEmptyDict("PIMPLE");
  const auto refuse = [&](const char* keyword, const char* remedy) {
    throw inputError(std::string(fvSolution.name()) + ": PIMPLE: " + keyword + " is '" + pimple.get<word>(keyword) +
                     "', which annulusFoam does not do: " + remedy);
  };
  if (!pimple.getOrDefault<Switch>("solveFlow", true)) {
    refuse("solveFlow", "the flow is all that it solves; remove the entry");
  }
  for (const char* keyword : {"frozenFlow", "transonic"}) {
    if (pimple.getOrDefault<Switch>(keyword, false)) {
      refuse(keyword, "remove the entry");
    }
  }
  if (pimple.found("pRefPoint")) {
    throw inputError(std::string(fvSolution.name()) +
                     ": PIMPLE: pRefPoint is not read; give the number of a cell as pRefCell");
  }
  const label outer = pimple.getOrDefault<label>("nOuterCorrectors", 1);
  static const std::set<std::string> acting{"nOuterCorrectors",  "nCorrectors", "nNonOrthogonalCorrectors",
                                            "momentumPredictor", "consistent",  "residualControl",
                                            "pRefCell",          "pRefValue",   "solveFlow",
                                            "frozenFlow",        "transonic"};
  for (const entry& e : pimple) {
    const std::string name = e.keyword();
    if (name == "turbOnFinalIterOnly" ? outer < 2 : !acting.count(name)) {
      join(unread, "PIMPLE/" + name + (name == "turbOnFinalIterOnly" ? " (nOuterCorrectors is 1)" : ""));
    }
    if (name == "residualControl" && outer < 2) {
      join(unread, "PIMPLE/residualControl (nOuterCorrectors is 1)");
    }
  }
  const auto ofTurbulence = [&](const std::string& name) { return turbulent && turbulenceField(name); };
  const auto solved = [&](const std::string& name) {
    const std::string end = "Final";
    const bool final = name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    const std::string field = final ? name.substr(0, name.size() - end.size()) : name;
    return field == "U" || field == "p" || ofTurbulence(field);
  };
  for (const entry& e : fvSolution.subOrEmptyDict("solvers")) {
    if (!e.keyword().isPattern() && !solved(e.keyword())) {
      join(unread, "solvers/" + e.keyword());
    }
  }
  const dictionary& relaxation = fvSolution.subOrEmptyDict("relaxationFactors");
  for (const char* kind : {"fields", "equations"}) {
    for (const entry& e : relaxation.subOrEmptyDict(kind)) {
      const std::string path = std::string("relaxationFactors/") + kind + "/" + e.keyword();
      const std::string field = std::string(kind) == "fields" ? "p" : "U";
      const bool ours = e.keyword() == field || (field == "U" && ofTurbulence(e.keyword()));
      const bool final = e.keyword() == field + "Final" || (field == "U" && turbulent && solved(e.keyword()) && !ours);
      if (e.keyword().isPattern() || final) {
        continue;
      }
      if (!ours) {
        join(unread, path);
      } else if (outer < 2) {
        join(unread, path + " (nOuterCorrectors is 1: the only iteration is the last one, which takes " + e.keyword() +
                         "Final)");
      }
    }
  }
  if (!unread.empty()) {
    note(std::string(fvSolution.name()) + ": without effect: " + unread);
  }
}

namespace {

template <class Field> void checkTypes(const Field& field) {
  for (const auto& patch : field.boundaryField()) {
    for (const caseType& known : boundaryTypes()) {
      if (patch.type() == known.name) {
        throw inputError(field.objectPath() + ": " + patch.patch().name() + " is of type '" + patch.type() +
                         "', which annulusFoam cannot serve: " + known.remedy);
      }
    }
  }
}

} // namespace

void checkBoundaryTypes(const volVectorField& U, const volScalarField& p) {
  checkTypes(U);
  checkTypes(p);
}

void startFunctionObjects(Time& time) {
  const dictionary* const functions = time.controlDict().findDict("functions");
  if (!functions || functions->empty()) {
    return;
  }
  time.functionObjects().start();
  std::string missing;
  for (const entry& e : *functions) {
    if (e.isDict() && e.dict().getOrDefault<Switch>("enabled", true) &&
        time.functionObjects().findObjectID(e.keyword()) < 0) {
      join(missing, e.keyword() + " (type " + e.dict().getOrDefault<word>("type", "missing") + ")");
    }
  }
  if (!missing.empty()) {
    note("functions of system/controlDict that could not be made, and do nothing: " + missing +
         ": correct type, libs and entries, of which OpenFOAM's warning above says more");
  }
}

void checkStatedDensities(const Time& time, scalar rho) {
  const dictionary* const functions = time.controlDict().findDict("functions");
  if (!functions) {
    return;
  }
  for (const entry& e : *functions) {
    scalar stated = rho;
    if (e.isDict() && e.dict().readIfPresent("rhoInf", stated) && mag(stated - rho) > SMALL * rho) {
      OStringStream text;
      text << "functions/" << e.keyword() << " of system/controlDict: rhoInf is " << stated
           << ", but rho of constant/transportProperties is " << rho
           << ": it computes for a fluid of the former density";
      note(text.str());
    }
  }
}

} // namespace Foam

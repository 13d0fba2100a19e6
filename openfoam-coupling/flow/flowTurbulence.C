// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the model and loads the library that makes it.
#include "flow/flowTurbulence.H"

#include "flow/caseFiles.H"
#include "flow/turbulence/makeTurbulence.H"
#include "support/inputError.H"

#include "IOdictionary.H"
#include "fvMesh.H"
#include "turbulenceModel.H"

#include <algorithm>
#include <dlfcn.h>
#include <string>

namespace Foam {

namespace {

// The momentum equation takes nut alone: models with a stress of another form are not in these lists.
const std::vector<std::string> besideParticles{"kEpsilon", "realizableKE", "kOmegaSST"};
const std::vector<std::string> singlePhase{"kEpsilon",       "realizableKE",    "RNGkEpsilon", "LaunderSharmaKE",
                                           "LamBremhorstKE", "LienLeschziner",  "kOmega",      "kOmegaSST",
                                           "kOmegaSSTLM",    "SpalartAllmaras", "v2f",         "kEpsilonPhitF"};

const std::vector<std::string> carried{"k", "epsilon", "omega", "nuTilda", "v2", "phit", "gammaInt", "ReThetat"};

const char* const library = "libeccentraTurbulence.so";

void checkModel(const dictionary& properties, bool coupled) {
  const dictionary& RAS = properties.subDict("RAS");
  const word keyword = RAS.found("model") ? "model" : "RASModel";
  const word model(RAS.get<word>(keyword));
  const std::vector<std::string>& known = coupled ? besideParticles : singlePhase;
  if (std::find(known.begin(), known.end(), model) != known.end()) {
    return;
  }
  std::string list;
  for (const std::string& name : known) {
    list += (list.empty() ? "" : name == known.back() ? " or " : ", ") + name;
  }
  throw inputError(RAS, keyword, model,
                   "give " + list + (coupled ? ", which have equations with the fluid fraction" : ""));
}

void checkFields(const fvMesh& mesh, const dictionary& properties) {
  const dictionary& RAS = properties.subDict("RAS");
  const std::string model = RAS.get<word>(RAS.found("model") ? "model" : "RASModel");
  const bool twoEquations = model.find("kEpsilon") == 0 || model.find("kOmega") == 0 || model == "realizableKE";
  if (!twoEquations) {
    return;
  }
  for (const char* name : {"k", model.find("kOmega") == 0 ? "omega" : "epsilon", "nut"}) {
    IOobject field(name, mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::NO_WRITE, false);
    if (!field.typeHeaderOk<volScalarField>(false)) {
      throw inputError(mesh.time().timeName() + "/" + name + ": there is no such field, but the model " + model +
                       " of constant/turbulenceProperties needs it; give it with wall functions (docs/turbulence.md)");
    }
  }
}

/// The library lies beside this one, whose run path finds it.
makeTurbulence* loaded() {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_GLOBAL);
  void* const symbol = handle ? dlsym(handle, makeTurbulenceName) : nullptr;
  if (!symbol) {
    throw inputError("constant/turbulenceProperties: simulationType is RAS, but the library of the models cannot be "
                     "loaded (" +
                     std::string(dlerror()) + "): install " + library + " beside the other libraries of Eccentra");
  }
  return reinterpret_cast<makeTurbulence*>(symbol);
}

} // namespace

autoPtr<flowTurbulence> flowTurbulence::New(const volVectorField& U, const surfaceScalarField& phi,
                                            const fluidTransport& transport, const volScalarField* alpha,
                                            const surfaceScalarField* alphaPhi) {
  const fvMesh& mesh = U.mesh();
  if (!turbulent(mesh.time())) {
    return nullptr;
  }
  const IOdictionary properties(IOobject(turbulenceModel::propertiesName, mesh.time().constant(), mesh,
                                         IOobject::MUST_READ, IOobject::NO_WRITE, false));
  checkModel(properties, alpha);
  checkFields(mesh, properties);
  autoPtr<flowTurbulence> made(loaded()(U, phi, transport, alpha, alphaPhi));
  made->model().validate();
  // Second-order time schemes find both old levels, and a restart writes them.
  for (volScalarField* const field : transported(mesh)) {
    field->oldTime().oldTime();
  }
  return made;
}

std::vector<volScalarField*> flowTurbulence::transported(const fvMesh& mesh) {
  std::vector<volScalarField*> fields;
  if (eddyViscosity(mesh)) {
    for (const std::string& name : carried) {
      if (mesh.foundObject<volScalarField>(name)) {
        fields.push_back(&mesh.lookupObjectRef<volScalarField>(name));
      }
    }
  }
  return fields;
}

volScalarField* flowTurbulence::eddyViscosity(const fvMesh& mesh) {
  return mesh.foundObject<volScalarField>("nut") ? &mesh.lookupObjectRef<volScalarField>("nut") : nullptr;
}

} // namespace Foam

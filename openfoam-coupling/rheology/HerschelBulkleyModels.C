// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of herschel_bulkley.h as viscosity models that any incompressible solver can select.
#include "rheology/yieldStressViscosity.H"

#include "addToRunTimeSelectionTable.H"
#include "surfaceFields.H"

namespace Foam {
namespace viscosityModels {

/// viscosity: a law of herschel_bulkley.h.
template <double (*viscosity)(const eccentra::rheology::HerschelBulkley&, double)>
class yieldStressLaw : public yieldStressViscosity {
 public:
  TypeName("yieldStressLaw");

  yieldStressLaw(const word& name, const dictionary& transportProperties, const volVectorField& U,
                 const surfaceScalarField& phi)
      : yieldStressViscosity(name, typeName, transportProperties, U, phi) {
    initialise();
  }

 protected:
  void evaluate(const eccentra::rheology::HerschelBulkley& kinematic, scalarField& rate) const override {
    for (scalar& value : rate) {
      value = viscosity(kinematic, value);
    }
  }
};

using HerschelBulkleyCapped = yieldStressLaw<eccentra::rheology::capped_viscosity>;
using HerschelBulkleyRegularised = yieldStressLaw<eccentra::rheology::regularised_viscosity>;

defineTemplateTypeNameAndDebugWithName(HerschelBulkleyCapped, "HerschelBulkleyCapped", 0);
defineTemplateTypeNameAndDebugWithName(HerschelBulkleyRegularised, "HerschelBulkleyRegularised", 0);
addToRunTimeSelectionTable(viscosityModel, HerschelBulkleyCapped, dictionary);
addToRunTimeSelectionTable(viscosityModel, HerschelBulkleyRegularised, dictionary);

} // namespace viscosityModels
} // namespace Foam

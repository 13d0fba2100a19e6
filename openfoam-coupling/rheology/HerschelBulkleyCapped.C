// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The capped law of herschel_bulkley.h as a viscosity model that any incompressible solver can select.
#include "yieldStressViscosity.H"

#include "addToRunTimeSelectionTable.H"
#include "surfaceFields.H"

namespace Foam {
namespace viscosityModels {

class HerschelBulkleyCapped : public yieldStressViscosity {
 public:
  TypeName("HerschelBulkleyCapped");

  HerschelBulkleyCapped(const word& name, const dictionary& transportProperties, const volVectorField& U,
                        const surfaceScalarField& phi)
      : yieldStressViscosity(name, typeName, transportProperties, U, phi) {
    initialise();
  }

 protected:
  void evaluate(const eccentra::rheology::HerschelBulkley& kinematic, scalarField& rate) const override {
    for (scalar& value : rate) {
      value = eccentra::rheology::capped_viscosity(kinematic, value);
    }
  }
};

defineTypeNameAndDebug(HerschelBulkleyCapped, 0);
addToRunTimeSelectionTable(viscosityModel, HerschelBulkleyCapped, dictionary);

} // namespace viscosityModels
} // namespace Foam

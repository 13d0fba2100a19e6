// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of contact models and their kernels.
#include "contact/contact_models.h"

#include <cmath>

namespace eccentra::contact {

namespace {

/// Eq (12)-(17): kn = 4/3 E* a, kt = 8 G* a, a the contact radius; stock's gamma_n = 2 sqrt(5/6) beta sqrt(2 E* a m*)
/// and gamma_t = 2 sqrt(5/6) beta sqrt(kt m*), the paper's 2 beta sqrt(4/3 E* a m*) and 2 beta sqrt(2/7 kt m*).
struct Hertz {
  template <class Block> static void stiffness(Block& c, int n, const DampingChoice& damping) {
    const bool stock = damping.law == DampingLaw::stock;
    const double factor = stock ? 2 * std::sqrt(5. / 6.) : 2;
    const double normal = factor * std::sqrt(stock ? 2 : 4. / 3.);
    const double tangential = damping.tangential ? factor * std::sqrt(8 * (stock ? 1 : 2. / 7.)) : 0;
#pragma GCC ivdep
    for (int m = 0; m < n; ++m) {
      // E*, G* [Pa], and beta = ln e / sqrt(pi^2 + ln^2 e) <= 0.
      const double a = c.contact_radius[m], beta = -c.material[2][m];
      const double ea = c.material[0][m] * a, ga = c.material[1][m] * a, mass = c.mass[m];
      c.kn[m] = 4. / 3. * ea;
      c.kt[m] = 8 * ga;
      c.gamma_n[m] = normal * beta * std::sqrt(ea * mass);
      c.gamma_t[m] = tangential * beta * std::sqrt(ga * mass);
    }
  }
};

template <class Model> ContactModel row(const char* name, std::vector<const char*> properties, double exponent) {
  return {name, std::move(properties), exponent, &Model::template stiffness<ContactBlock>,
          &Model::template stiffness<LargeContactBlock>};
}

} // namespace

const std::vector<ContactModel>& contact_models() {
  static const std::vector<ContactModel> models = {
      row<Hertz>("hertz", {"Yeff", "Geff", "betaeff"}, 1.5),
  };
  return models;
}

const ContactModel* find_contact_model(const std::string& name) {
  for (const ContactModel& model : contact_models())
    if (name == model.name)
      return &model;
  return nullptr;
}

} // namespace eccentra::contact

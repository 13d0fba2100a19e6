// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a force law may ask of the fluid, and what it hands back. The union of what is asked for decides what the solver
// computes, samples and sends; nothing else exists.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace eccentra::link {

/// Bits of a set of fluid quantities at a particle's centre. World frame, SI.
enum Quantity : unsigned {
  kVelocity = 1u << 0,         ///< fluid velocity u_f [m/s]
  kFraction = 1u << 1,         ///< fluid volume fraction alpha [-]
  kPressureGradient = 1u << 2, ///< grad p_rgh [Pa/m], with the gradient that drives a periodic section
  kStressDivergence = 1u << 3, ///< div tau [N/m3], viscous stress of the fluid
  kVorticity = 1u << 4,        ///< curl u_f [1/s]
  kVelocityGradient = 1u << 5, ///< d u_r/d x_c by rows [1/s]
  kTurbulence = 1u << 6,       ///< kinetic energy k [m2/s2] and dissipation epsilon [m2/s3] of a turbulence model
};

/// One quantity: its bit, the word for it in scripts and reports, doubles per particle (1 a scalar, 2 a pair, 3 a
/// vector, 9 a tensor by rows), and the value of each where the fluid is clear and at rest.
struct FlowQuantity {
  Quantity bit;     ///< place in a set
  const char* name; ///< in scripts and reports
  int columns;      ///< doubles per particle: 1, 2, 3 or 9
  double at_rest;   ///< of each of them
};

/// All quantities in the order of their bits, in which they also travel. Every loop over quantities walks this table;
/// docs/add-a-flow-quantity.md says what else a new one takes.
inline constexpr FlowQuantity kFlowQuantities[] = {
    {kVelocity, "velocity", 3, 0.0},
    {kFraction, "fraction", 1, 1.0},
    {kPressureGradient, "pressure_gradient", 3, 0.0},
    {kStressDivergence, "stress_divergence", 3, 0.0},
    {kVorticity, "vorticity", 3, 0.0},
    {kVelocityGradient, "velocity_gradient", 9, 0.0},
    {kTurbulence, "turbulence", 2, 0.0},
};
inline constexpr int kFlowQuantityCount = sizeof kFlowQuantities / sizeof kFlowQuantities[0];
/// The set of all quantities.
inline constexpr unsigned kAllQuantities = (1u << kFlowQuantityCount) - 1;

/// Row of a quantity in the table.
constexpr int place_of(Quantity bit) {
  int place = 0;
  while (!(bit >> place & 1u))
    ++place;
  return place;
}
/// Doubles per particle.
constexpr int columns_of(Quantity bit) {
  return kFlowQuantities[place_of(bit)].columns;
}

namespace detail {
constexpr bool in_order_of_bits() {
  for (int place = 0; place < kFlowQuantityCount; ++place)
    if (kFlowQuantities[place].bit != 1u << place)
      return false;
  return true;
}
} // namespace detail
static_assert(detail::in_order_of_bits(), "a row's place in the table is its bit");

/// Doubles per particle of a set of quantities.
constexpr int columns_of_set(unsigned quantities) {
  int columns = 0;
  for (const FlowQuantity& quantity : kFlowQuantities)
    columns += quantities & quantity.bit ? quantity.columns : 0;
  return columns;
}

/// The words for a set of quantities, with `separator` between them; empty for the empty set. Bits that no quantity has
/// are named by their numbers.
inline std::string names_of(unsigned quantities, const char* separator = ", ") {
  std::string names;
  for (unsigned place = 0; place < 32; ++place)
    if (quantities >> place & 1u)
      names += (names.empty() ? "" : separator) + (place < kFlowQuantityCount ? std::string(kFlowQuantities[place].name)
                                                                              : "number " + std::to_string(place));
  return names;
}

/// One value for each quantity, found by the quantity's bit.
template <class Value> class PerQuantity {
 public:
  /// The value of a quantity.
  constexpr Value& operator[](Quantity bit) { return values_[place_of(bit)]; }
  constexpr const Value& operator[](Quantity bit) const { return values_[place_of(bit)]; }

 private:
  std::array<Value, kFlowQuantityCount> values_{};
};

/// Per-atom samples of the flow; rows are local atoms. An array is null where its quantity is not asked for.
class FluidSamples : public PerQuantity<double*> {
 public:
  /// Rows of three components.
  using Vectors = double (*)[3];
  /// One value per atom.
  using Scalars = double*;
  /// Rows of two values.
  using Pairs = double (*)[2];
  /// Rows of nine components.
  using Tensors = double (*)[9];

  /// u_f [m/s].
  Vectors velocity() const { return rows<kVelocity>(); }
  /// alpha [-].
  Scalars fraction() const { return (*this)[kFraction]; }
  /// grad p_rgh [Pa/m].
  Vectors pressure_gradient() const { return rows<kPressureGradient>(); }
  /// div tau [N/m3].
  Vectors stress_divergence() const { return rows<kStressDivergence>(); }
  /// curl u_f [1/s].
  Vectors vorticity() const { return rows<kVorticity>(); }
  /// d u_r/d x_c by rows [1/s].
  Tensors velocity_gradient() const { return rows<kVelocityGradient>(); }
  /// k [m2/s2] and epsilon [m2/s3].
  Pairs turbulence() const { return rows<kTurbulence>(); }

 private:
  template <Quantity bit> auto rows() const -> double (*)[columns_of(bit)] {
    return reinterpret_cast<double(*)[columns_of(bit)]>((*this)[bit]);
  }
};

/// What the fluid did to each particle since the last reset, as time integrals over DEM steps; rows are local atoms.
/// Drag and lifts only (S_f of eq 2 and 3): pressure gradient and buoyancy are in alpha grad p already.
struct FluidReaction {
  double (*impulse)[3] = nullptr;     ///< integral of F_D + F_S + F_M dt [N s]; the fluid receives the opposite
  double* drag_coefficient = nullptr; ///< integral of beta dt [kg], drag force = beta (u_f - u_p): its linearisation
  double elapsed = 0.0;               ///< integrated time [s]
};

} // namespace eccentra::link

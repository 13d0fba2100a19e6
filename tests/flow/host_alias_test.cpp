// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The host's in-place field operators give right numbers only without __restrict__: built twice, with and without the
// cure.
#include "Random.H"
#include "tensorField.H"
#include "vectorField.H"

#include <cstdio>

using namespace Foam;

namespace {

constexpr label kSize = 1000;
// Round-off is 1e-15; the miscompiled loops are wrong by tens of percent.
constexpr scalar kWrong = 1e-6;

template <class Type> scalar largest_error(const Field<Type>& value, const Field<Type>& reference) {
  scalar error = 0;
  forAll(value, i) {
    error = max(error, mag(value[i] - reference[i]) / (mag(reference[i]) + VSMALL));
  }
  return error;
}

/// Largest error of operators whose result reuses the storage of an operand, against the same without reuse. At -O3 g++
/// 12 and 13 break the first three, g++ 14 the fourth.
scalar in_place_error() {
  Random random(1);
  tensorField a(kSize), b(kSize);
  vectorField v(kSize), w(kSize);
  forAll(a, i) {
    a[i] = random.sample01<tensor>() + 2 * tensor::I;
    b[i] = random.sample01<tensor>();
    v[i] = random.sample01<vector>();
    w[i] = random.sample01<vector>();
  }
  scalar error = 0;
  error = max(error, largest_error(vectorField(a & tmp<vectorField>(new vectorField(v))), vectorField(a & v)));
  error = max(error, largest_error(vectorField(tmp<vectorField>(new vectorField(v)) & a), vectorField(v & a)));
  error = max(error, largest_error(tensorField(tmp<tensorField>(new tensorField(a)) & b), tensorField(a & b)));
  error = max(error, largest_error(tensorField(a & tmp<tensorField>(new tensorField(b))), tensorField(a & b)));
  error = max(error, largest_error(vectorField(tmp<vectorField>(new vectorField(v)) ^ w), vectorField(v ^ w)));
  return error;
}

} // namespace

/// Exit code 0: right numbers (built with the cure) or wrong ones (built without), as the build says.
int main() {
  const scalar error = in_place_error();
#ifdef ECCENTRA_WITHOUT_CURE
  std::printf("without -D__restrict__=: in-place operators are wrong by %g\n", error);
  return error > kWrong ? 0 : 1;
#else
  std::printf("with -D__restrict__=: in-place operators are wrong by %g\n", error);
  return error < kWrong ? 0 : 1;
#endif
}

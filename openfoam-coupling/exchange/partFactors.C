// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/partFactors.H"

#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace eccentra::exchange {

partFactors::partFactors(int size, const std::vector<MatrixEntry>& lower) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const MatrixEntry& entry : lower)
    entries.emplace_back(entry.row, entry.column, entry.value);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success)
    throw std::logic_error("partFactors: the matrix is not definite");
  const Eigen::SparseMatrix<double> triangle = factors.matrixL();
  const Eigen::VectorXd diagonal = factors.vectorD();
  place_.resize(size);
  for (int i = 0; i < size; ++i)
    place_[factors.permutationP().indices()[i]] = i;
  begin_.push_back(0);
  for (int column = 0; column < size; ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator at(triangle, column); at; ++at)
      if (at.row() > column) {
        row_.push_back(static_cast<int>(at.row()));
        value_.push_back(at.value());
      }
    begin_.push_back(static_cast<int>(row_.size()));
    inverse_.push_back(1 / diagonal[column]);
  }
}

template <int width> void partFactors::solve(FieldBundle<width>& values) const {
  const int size = static_cast<int>(place_.size());
  FieldBundle<width> x(size);
  for (int i = 0; i < size; ++i)
    x[i] = values[place_[i]];
  for (int column = 0; column < size; ++column)
    for (int k = begin_[column]; k < begin_[column + 1]; ++k)
      x[row_[k]].at -= value_[k] * x[column].at;
  for (int column = size - 1; column >= 0; --column) {
    auto sum = inverse_[column] * x[column].at;
    for (int k = begin_[column]; k < begin_[column + 1]; ++k)
      sum -= value_[k] * x[row_[k]].at;
    x[column].at = sum;
  }
  for (int i = 0; i < size; ++i)
    values[place_[i]] = x[i];
}

template void partFactors::solve(FieldBundle<kNarrow>&) const;
template void partFactors::solve(FieldBundle<kWide>&) const;

} // namespace eccentra::exchange

// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every rank hands its rows to the first one, which factorises the whole.
#include "flow/sparseCholesky.H"

#include "Pstream.H"
#include "addToRunTimeSelectionTable.H"
#include "support/foam_compat.H"

#include <Eigen/SparseCholesky>

#include <vector>

namespace Foam {

defineTypeNameAndDebug(sparseCholesky, 0);
lduMatrix::solver::addsymMatrixConstructorToTable<sparseCholesky> addSparseCholeskyToTable;

namespace {

using Entry = Eigen::Triplet<scalar>;

/// Entries of the whole matrix that this rank knows: of its rows the diagonal and what is left of it.
struct Rows {
  labelList row, column;
  scalarField value;
};

/// For each coupled patch the numbers of the cells on its other side.
List<labelList> numbersBeyond(const lduInterfaceFieldPtrsList& interfaces, const labelList& numbers) {
  const label before = Pstream::nRequests();
  forAll(interfaces, patchi) {
    if (interfaces.set(patchi)) {
      interfaces[patchi].interface().initInternalFieldTransfer(Pstream::commsTypes::nonBlocking, numbers);
    }
  }
  Pstream::waitRequests(before);
  List<labelList> beyond(interfaces.size());
  forAll(interfaces, patchi) {
    if (interfaces.set(patchi)) {
      beyond[patchi] = interfaces[patchi].interface().internalFieldTransfer(Pstream::commsTypes::nonBlocking, numbers);
    }
  }
  return beyond;
}

Rows rowsOf(const lduMatrix& matrix, const FieldField<Field, scalar>& coefficients,
            const lduInterfaceFieldPtrsList& interfaces, label first) {
  const labelUList &upper = matrix.lduAddr().upperAddr(), &lower = matrix.lduAddr().lowerAddr();
  const label own = matrix.diag().size();
  DynamicList<label> row(own + upper.size()), column(own + upper.size());
  DynamicList<scalar> value(own + upper.size());
  const auto add = [&](label i, label j, scalar a) {
    row.append(i);
    column.append(j);
    value.append(a);
  };
  labelList numbers(own);
  forAll(numbers, celli) {
    numbers[celli] = first + celli;
    add(numbers[celli], numbers[celli], matrix.diag()[celli]);
  }
  forAll(upper, facei) {
    add(numbers[upper[facei]], numbers[lower[facei]], matrix.upper()[facei]);
  }
  const List<labelList> beyond = numbersBeyond(interfaces, numbers);
  forAll(beyond, patchi) {
    forAll(beyond[patchi], facei) {
      const label here = numbers[interfaces[patchi].interface().faceCells()[facei]], there = beyond[patchi][facei];
      if (there < here) { // the other side has the same entry
        add(here, there, -coefficients[patchi][facei]);
      } else if (there == here) { // one cell around the whole of a periodic direction
        add(here, here, -coefficients[patchi][facei]);
      }
    }
  }
  return {labelList(row), labelList(column), scalarField(value)};
}

template <class Type> List<Type> gathered(const Type& own, label communicator) {
  List<Type> all(Pstream::nProcs(communicator));
  all[Pstream::myProcNo(communicator)] = own;
  Pstream::gatherList(all, Pstream::msgType(), communicator);
  return all;
}

/// Whether a constant is a solution of the homogeneous equations.
bool isSingular(const std::vector<Entry>& entries, label size) {
  scalarField sum(size, Zero), largest(size, Zero);
  for (const Entry& entry : entries) {
    sum[entry.row()] += entry.value();
    if (entry.row() == entry.col()) {
      largest[entry.row()] = mag(entry.value());
    } else {
      sum[entry.col()] += entry.value();
    }
  }
  return max(scalarField(mag(sum) - 1e-9 * largest)) <= 0;
}

} // namespace

struct sparseCholesky::Factors {
  Factors(label cellsOfThisRank, label ofMatrix) : communicator(ofMatrix) {
    labelList sizes(Pstream::nProcs(communicator), 0);
    sizes[Pstream::myProcNo(communicator)] = cellsOfThisRank;
    eccentra::compat::allGather(sizes, communicator);
    begin.setSize(sizes.size() + 1, 0);
    forAll(sizes, ranki) {
      begin[ranki + 1] = begin[ranki] + sizes[ranki];
    }
  }
  label first() const { return begin[Pstream::myProcNo(communicator)]; }
  label size() const { return begin[begin.size() - 1]; }

  label communicator;
  labelList begin; ///< of the rows of each rank, and their end
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<scalar>> ldlt;
};

sparseCholesky::sparseCholesky(const word& fieldName, const lduMatrix& matrix,
                               const FieldField<Field, scalar>& interfaceBouCoeffs,
                               const FieldField<Field, scalar>& interfaceIntCoeffs,
                               const lduInterfaceFieldPtrsList& interfaces, const dictionary& solverControls)
    : lduMatrix::solver(fieldName, matrix, interfaceBouCoeffs, interfaceIntCoeffs, interfaces, solverControls),
      factors_(new Factors(matrix.diag().size(), matrix.mesh().comm())) {
  Factors& f = *factors_;
  const Rows own = rowsOf(matrix_, interfaceBouCoeffs_, interfaces_, f.first());
  const List<labelList> rows = gathered(own.row, f.communicator), columns = gathered(own.column, f.communicator);
  const List<scalarField> values = gathered(own.value, f.communicator);
  bool solved = true;
  if (Pstream::master(f.communicator)) {
    std::vector<Entry> entries;
    forAll(rows, ranki) {
      forAll(rows[ranki], i) {
        entries.emplace_back(rows[ranki][i], columns[ranki][i], values[ranki][i]);
      }
    }
    const label size = f.size();
    if (isSingular(entries, size)) {
      entries.emplace_back(entries.front().row(), entries.front().row(), entries.front().value());
    }
    Eigen::SparseMatrix<scalar> whole(size, size);
    whole.setFromTriplets(entries.begin(), entries.end());
    f.ldlt.compute(whole);
    solved = f.ldlt.info() == Eigen::Success;
    if (solved) { // a Laplacian of OpenFOAM is negative definite
      const Eigen::VectorXd d = f.ldlt.vectorD();
      solved = (d.array() > 0).all() || (d.array() < 0).all();
    }
  }
  eccentra::compat::broadcast(solved, f.communicator);
  if (!solved) {
    FatalErrorInFunction << "solver sparseCholesky of " << fieldName_
                         << ": the matrix is not definite; take another solver in system/fvSolution"
                         << exit(FatalError);
  }
}

sparseCholesky::~sparseCholesky() = default;

solverPerformance sparseCholesky::solve(scalarField& psi, const scalarField& source, const direction cmpt) const {
  const Factors& f = *factors_;
  solverPerformance performance(typeName, fieldName_);
  scalarField product(psi.size()), work(psi.size());
  matrix_.Amul(product, psi, interfaceBouCoeffs_, interfaces_, cmpt);
  const scalar norm = normFactor(psi, source, product, work);
  performance.initialResidual() = gSumMag(scalarField(source - product), f.communicator) / norm;

  const List<scalarField> parts = gathered(source, f.communicator);
  scalarField whole;
  if (Pstream::master(f.communicator)) {
    Eigen::VectorXd right(f.size());
    forAll(parts, ranki) {
      forAll(parts[ranki], celli) {
        right[f.begin[ranki] + celli] = parts[ranki][celli];
      }
    }
    whole.setSize(right.size());
    Eigen::Map<Eigen::VectorXd>(whole.data(), whole.size()) = f.ldlt.solve(right);
  }
  eccentra::compat::broadcast(whole, f.communicator);
  forAll(psi, celli) {
    psi[celli] = whole[f.first() + celli];
  }

  matrix_.Amul(product, psi, interfaceBouCoeffs_, interfaces_, cmpt);
  performance.finalResidual() = gSumMag(scalarField(source - product), f.communicator) / norm;
  performance.nIterations() = 1;
  performance.checkConvergence(tolerance_, relTol_);
  return performance;
}

} // namespace Foam

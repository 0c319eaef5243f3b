// MUMPS, sequential: a multifrontal L D L^T with pivoting, for matrices of any inertia.

#include <dmumps_c.h>

#include <cmath>
#include <new>

#include "core/base/failure.hpp"
#include "core/statics/linear_solver.hpp"

#include <fmt/format.h>

namespace beadwork {

namespace {

constexpr int use_whole_communicator = -987654;  // MUMPS' own number for it

class Multifrontal final : public LinearSolver {
 public:
  Multifrontal() {
    mumps_.par = 1;
    mumps_.sym = 2;  // symmetric, of any inertia
    mumps_.comm_fortran = use_whole_communicator;
    call(-1);
    for (int k = 0; k < 4; ++k) mumps_.icntl[k] = k < 3 ? -1 : 0;  // it says nothing by itself
    control(7) = 4;                                                // order by PORD
    control(14) = 40;                                              // percent of room beyond the estimate
    control(24) = 1;                                               // finds pivots that are as good as nothing
  }
  ~Multifrontal() override { call(-2); }
  Multifrontal(const Multifrontal&) = delete;
  Multifrontal& operator=(const Multifrontal&) = delete;

  void analyse(const SymmetricMatrix& pattern) override {
    rows_.clear(), columns_.clear();
    rows_.reserve(pattern.row.size()), columns_.reserve(pattern.row.size());
    for (int column = 0; column < pattern.size(); ++column)
      for (int k = pattern.begin[static_cast<std::size_t>(column)];
           k < pattern.begin[static_cast<std::size_t>(column) + 1]; ++k) {
        rows_.push_back(pattern.row[static_cast<std::size_t>(k)] + 1);
        columns_.push_back(column + 1);
      }
    mumps_.n = pattern.size();
    mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
    call(1);
    require("analyse");
  }

  Real memory() const override { return 1e6 * mumps_.infog[15]; }

  Factored factor(const SymmetricMatrix& matrix) override {
    mumps_.a = const_cast<Real*>(matrix.value.data());  // it reads only
    call(2);
    for (int more = 0; more < 4 && (mumps_.infog[0] == -8 || mumps_.infog[0] == -9); ++more) {  // too little room
      control(14) *= 2;
      call(2);
    }
    if (mumps_.infog[0] == -13) throw std::bad_alloc();
    Factored result;
    result.negative = mumps_.infog[11];
    if (mumps_.infog[0] == -10) return {false, -1, -1};
    require("factor");
    if (mumps_.infog[27] > 0) result.weakest = mumps_.pivnul_list[0] - 1;
    return result;
  }

  bool solve(Vector& b) override {
    mumps_.rhs = b.data();
    mumps_.nrhs = 1;
    mumps_.lrhs = mumps_.n;
    call(3);
    require("solve");
    return true;
  }

 private:
  // Numbered as in its manual.
  int& control(int number) { return mumps_.icntl[number - 1]; }
  void call(int job) {
    mumps_.job = job;
    dmumps_c(&mumps_);
  }
  void require(const char* what) const {
    if (mumps_.infog[0] < 0)
      throw MachineFailure(
          fmt::format("the linear solver MUMPS failed to {}: error {}, {}", what, mumps_.infog[0], mumps_.infog[1]));
  }

  DMUMPS_STRUC_C mumps_{};
  std::vector<int> rows_, columns_;  // counted from 1
};

}  // namespace

std::unique_ptr<LinearSolver> make_multifrontal() { return std::make_unique<Multifrontal>(); }

}  // namespace beadwork

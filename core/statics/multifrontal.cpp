// MUMPS, sequential: a multifrontal L D L^T with pivoting, for matrices of any inertia.

#include <dmumps_c.h>
#include <metis.h>

#include <cmath>
#include <new>

#include "core/base/failure.hpp"
#include "core/statics/linear_solver.hpp"

#include <fmt/format.h>

/// Of OpenBLAS, where MUMPS was linked with it: more threads would change bits.
extern "C" void openblas_set_num_threads(int count) __attribute__((weak));

namespace beadwork {

namespace {

constexpr int use_whole_communicator = -987654;  // MUMPS' own number for it

class Multifrontal final : public LinearSolver {
 public:
  Multifrontal() {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    mumps_.par = 1;
    mumps_.sym = 2;  // symmetric, of any inertia
    mumps_.comm_fortran = use_whole_communicator;
    call(-1);
    for (int k = 0; k < 4; ++k) mumps_.icntl[k] = k < 3 ? -1 : 0;  // it says nothing by itself
    control(6) = 0;  // no permutation by numbers, which are not known when it orders
    control(12) = 1;
    control(14) = 40;  // percent of room beyond the estimate
    control(24) = 1;   // finds pivots that are as good as nothing
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
    order(pattern);
    mumps_.n = pattern.size();
    mumps_.nnz = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn = rows_.data();
    mumps_.jcn = columns_.data();
    mumps_.a = nullptr;  // of the numbers of a matrix before nothing may be read
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
  // By nested dissection, of our own call to METIS: it is the same each time, which an order that MUMPS asks a library
  // for need not be, and small matrices, on which some orderings stumble, are left to MUMPS' own minimum degree.
  void order(const SymmetricMatrix& pattern) {
    constexpr int small = 500;
    control(7) = pattern.size() < small ? 0 : 1;
    if (pattern.size() < small) return;
    const auto n = static_cast<std::size_t>(pattern.size());
    std::vector<idx_t> begin(n + 1, 0), neighbours;
    for (std::size_t c = 0; c < n; ++c)
      for (int k = pattern.begin[c] + 1; k < pattern.begin[c + 1]; ++k)
        ++begin[c + 1], ++begin[static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)]) + 1];
    for (std::size_t c = 0; c < n; ++c) begin[c + 1] += begin[c];
    neighbours.resize(static_cast<std::size_t>(begin[n]));
    std::vector<idx_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t c = 0; c < n; ++c)
      for (int k = pattern.begin[c] + 1; k < pattern.begin[c + 1]; ++k) {
        const auto r = static_cast<std::size_t>(pattern.row[static_cast<std::size_t>(k)]);
        neighbours[static_cast<std::size_t>(next[c]++)] = static_cast<idx_t>(r);
        neighbours[static_cast<std::size_t>(next[r]++)] = static_cast<idx_t>(c);
      }
    auto count = static_cast<idx_t>(n);
    std::vector<idx_t> old_of(n), place_of(n);
    if (METIS_NodeND(&count, begin.data(), neighbours.data(), nullptr, nullptr, old_of.data(), place_of.data()) !=
        METIS_OK)
      throw MachineFailure("METIS found no order of elimination");
    places_.resize(n);
    for (std::size_t u = 0; u < n; ++u) places_[u] = place_of[u] + 1;
    mumps_.perm_in = places_.data();
  }

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
  std::vector<int> rows_, columns_, places_;  // counted from 1
};

}  // namespace

std::unique_ptr<LinearSolver> make_multifrontal() { return std::make_unique<Multifrontal>(); }

}  // namespace beadwork

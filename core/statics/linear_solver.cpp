#include "core/statics/linear_solver.hpp"

#include <stdexcept>

namespace beadwork {

const std::vector<std::string>& linear_solvers() {
  static const std::vector<std::string> names{"multifrontal", "simplicial", "conjugate-gradients"};
  return names;
}

std::unique_ptr<LinearSolver> linear_solver(const std::string& name) {
  if (name == "multifrontal") return make_multifrontal();
  if (name == "simplicial") return make_simplicial();
  if (name == "conjugate-gradients") return make_conjugate_gradients();
  throw std::logic_error("no linear solver '" + name + "'");
}

}  // namespace beadwork

#include "core/plugin/failure.hpp"

#include "core/domain/vocabulary.hpp"

namespace beadwork {

Failure::Failure(On judged)
    : Plugin(its_kind), utilisation{this, judged == On::elements ? field::element_utilisation : field::utilisation} {
  utilisation.always();
}

void Failure::note_spared(const Domain& domain) {
  if (!except.given()) return;
  spared_.assign(static_cast<std::size_t>(domain.size()), 0);
  for (const std::string& set : *except)
    for (const Index row : domain.set(set)) spared_[static_cast<std::size_t>(row)] = 1;
}

}  // namespace beadwork

#include "core/plugin/failure.hpp"

#include "core/domain/vocabulary.hpp"

namespace beadwork {

Failure::Failure(On judged)
    : Plugin(its_kind), utilisation{this, judged == On::elements ? field::element_utilisation : field::utilisation} {
  utilisation.always();
}

}  // namespace beadwork

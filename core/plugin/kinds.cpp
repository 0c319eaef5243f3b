#include "core/plugin/kinds.hpp"

#include "core/domain/vocabulary.hpp"

namespace beadwork {

const Field& Failure::field_utilisation() { return field::utilisation; }

}  // namespace beadwork

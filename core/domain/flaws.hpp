#pragma once
// Bonds that were broken from the start: no break of theirs was ever logged.

#include "core/domain/domain.hpp"

namespace beadwork {

/// How many of a family.
Index flaws(const Domain& domain, const BondTable& table);

}  // namespace beadwork

#pragma once
// An expression as the resolved deck gives it: no parameters, everything in SI.

#include <span>
#include <string>

#include "core/deck/tokens.hpp"

namespace beadwork {

/// The tokens as a text that compiles, in a deck without any parameters, to the same steps on the same numbers.
/// `values` holds one quantity for each token; those of literals and parameters count.
std::string spelt_in_si(std::span<const Token> tokens, std::span<const Quantity> values);

}  // namespace beadwork

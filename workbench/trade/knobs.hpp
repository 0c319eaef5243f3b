#pragma once
// The parameters of a deck that trade speed for accuracy: those whose value an attribute takes that its plugin has
// declared a knob.

#include <string>
#include <vector>

#include "core/loop/load.hpp"

namespace beadwork::trade {

struct DeckKnob {
  std::string parameter;                    ///< of the deck
  std::string of;                           ///< what it sets: "verlet: safety"
  std::string now;                          ///< its value, as it stands in the deck
  std::vector<std::string> slower;          ///< values that take longer and are the more accurate, the nearest first
  std::vector<std::string> faster;          ///< the other way
  std::vector<std::string> values() const;  ///< all but the present one
};

/// In the order of the deck's parameters. A parameter that is worked out from others is none.
std::vector<DeckKnob> knobs_of(const Loaded& loaded);
/// Knobs that no parameter of the deck sets, as "verlet: safety".
std::vector<std::string> other_knobs(const Loaded& loaded);
/// "name=value,value": a knob of these values, whether it is declared one or not. DeckFailure if the deck has no such
/// parameter.
DeckKnob knob_of(const std::string& text, const Loaded& loaded);

}  // namespace beadwork::trade

#pragma once
// The laws of a deck, each as it stands there, made fit for a scene of two elements.

#include <array>
#include <string>
#include <vector>

#include "core/loop/scene.hpp"

namespace beadwork::law {

struct Family {
  std::string name, tag;
  bool is_contact = false, turns = false;
  std::array<std::string, 2> between;  ///< the sets of the deck
  PlainNode node;                      ///< the law between the sets "first" and "second"
  std::vector<PlainNode> criteria;     ///< those of <fail> that judge it
  std::vector<PlainNode> derived;      ///< what <derive> sets of the fields that these read
  std::vector<std::string> remarks;    ///< in what one bond differs from those of the deck
};

/// Families of bonds, then contacts between elements, in the order of the deck.
std::vector<Family> families_of(const Scene& scene);

}  // namespace beadwork::law

#pragma once
// Packings to look at: a unit cube, and the three steps of filling one after the other.

#include <string>

#include "core/packing/packing.hpp"

namespace beadwork::packing {

inline Request cube(std::int64_t count, std::uint64_t seed = 1) {
  Request request;
  request.region = Box{{0, 0, 0}, {1, 1, 1}};
  request.count = count;
  request.seed = seed;
  return request;
}

inline Packing filled(const Request& request, const ForcedFilling& forced = {}, const Relaxation& relaxed = {}) {
  Packing packing = free_filling(request);
  forced_filling(packing, forced);
  relaxation(packing, relaxed);
  return packing;
}

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& e) {
    return e.what();
  } catch (const PackingFailure& e) {
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace beadwork::packing

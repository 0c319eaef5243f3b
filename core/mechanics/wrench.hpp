#pragma once
// What a bond does to the two elements that it joins.

#include "core/base/types.hpp"

namespace beadwork {

template <class T>
struct Wrench {
  Vec<T> force;    ///< on end 2; end 1 gets the opposite [N]
  Vec<T> torque1;  ///< on end 1, about its centre [N m]
  Vec<T> torque2;  ///< on end 2, about its centre [N m]
};

}  // namespace beadwork

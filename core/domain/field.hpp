#pragma once
// What a field is, apart from where its numbers lie.

#include <string>
#include <type_traits>

#include "core/base/types.hpp"

namespace beadwork {

enum class On : std::uint8_t { elements, bonds, scene };
enum class Type : std::uint8_t { real, vec3, quat, index, state, sym3 };

/// Break state of a bond; what is `broken` or beyond takes part in no loop unless its law says so.
enum class State : std::uint8_t { intact = 0, softening = 1, broken = 2 };

template <class T>
constexpr Type type_of() {
  using U = std::remove_const_t<T>;
  if constexpr (std::is_same_v<U, Real>)
    return Type::real;
  else if constexpr (std::is_same_v<U, Vec3>)
    return Type::vec3;
  else if constexpr (std::is_same_v<U, Quat>)
    return Type::quat;
  else if constexpr (std::is_same_v<U, Sym3>)
    return Type::sym3;
  else if constexpr (std::is_same_v<U, Index>)
    return Type::index;
  else {
    static_assert(std::is_same_v<U, State>, "a column holds Real, Vec3, Quat, Sym3, Index or State");
    return Type::state;
  }
}

constexpr int components(Type type) {
  return type == Type::vec3 ? 3 : type == Type::quat ? 4 : type == Type::sym3 ? 6 : 1;
}
constexpr std::size_t component_bytes(Type type) {
  return type == Type::index ? sizeof(Index) : type == Type::state ? sizeof(State) : sizeof(Real);
}
constexpr std::size_t bytes(Type type) { return static_cast<std::size_t>(components(type)) * component_bytes(type); }
const char* type_name(Type type);
const char* place_name(On on);

/// A declared array: on what, of which type and unit, and in words.
struct Field {
  std::string name;
  On on = On::elements;
  Type type = Type::real;
  std::string unit = "1";
  std::string doc;
  std::string line = "";  ///< fields of one line lie side by side in memory, row by row
};

}  // namespace beadwork

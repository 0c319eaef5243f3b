#pragma once
// How a loop sees a column: a base, a stride from row to row, and a stride from component to component. So position
// and orientation can lie side by side in one line of eight numbers, and the components of a bond's vector each in a
// plane of their own, without a loop knowing.

#include <type_traits>

#include "core/domain/field.hpp"

namespace beadwork {

template <class T>
class View {
  using Value = std::remove_const_t<T>;
  static constexpr bool scalar =
      !std::is_same_v<Value, Vec3> && !std::is_same_v<Value, Quat> && !std::is_same_v<Value, Sym3>;
  using Scalar = std::conditional_t<scalar, Value, Real>;
  using Byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
  using Component = std::conditional_t<std::is_const_v<T>, const Scalar, Scalar>;

 public:
  View() = default;
  View(Byte* base, std::size_t stride, std::size_t plane) : base_(base), stride_(stride), plane_(plane) {}
  operator View<const Value>() const requires(!std::is_const_v<T>) { return {base_, stride_, plane_}; }

  explicit operator bool() const { return base_ != nullptr; }

  /// Component `c` of row `row`.
  [[gnu::always_inline]] Component& at(Index row, int c) const {
    return *reinterpret_cast<Component*>(base_ + static_cast<std::size_t>(row) * stride_ +
                                         static_cast<std::size_t>(c) * plane_);
  }

  /// The row's value; of a scalar column the number itself, to read or to set. Vectors and quaternions are told, not
  /// lent: they are const, so that `force[row] += f` does not compile, where `force.add(row, f)` is meant.
  [[gnu::always_inline]] std::conditional_t<scalar, Component&, const Value> operator[](Index row) const {
    if constexpr (scalar)
      return at(row, 0);
    else if constexpr (std::is_same_v<Value, Vec3>)
      return Vec3(at(row, 0), at(row, 1), at(row, 2));
    else if constexpr (std::is_same_v<Value, Sym3>)
      return Sym3{at(row, 0), at(row, 1), at(row, 2), at(row, 3), at(row, 4), at(row, 5)};
    else
      return Quat{at(row, 0), Vec3(at(row, 1), at(row, 2), at(row, 3))};
  }

  [[gnu::always_inline]] void set(Index row, const Value& value) const requires(!std::is_const_v<T>) {
    if constexpr (scalar) {
      at(row, 0) = value;
    } else if constexpr (std::is_same_v<Value, Vec3>) {
      for (int c = 0; c < 3; ++c) at(row, c) = value[c];
    } else if constexpr (std::is_same_v<Value, Sym3>) {
      const Real numbers[] = {value.xx, value.xy, value.xz, value.yy, value.yz, value.zz};
      for (int c = 0; c < 6; ++c) at(row, c) = numbers[c];
    } else {
      at(row, 0) = value.w;
      for (int c = 0; c < 3; ++c) at(row, c + 1) = value.v[c];
    }
  }

  [[gnu::always_inline]] void add(Index row, const Value& value) const requires(!std::is_const_v<T>) {
    if constexpr (scalar) {
      at(row, 0) += value;
    } else if constexpr (std::is_same_v<Value, Sym3>) {
      const Real numbers[] = {value.xx, value.xy, value.xz, value.yy, value.yz, value.zz};
      for (int c = 0; c < 6; ++c) at(row, c) += numbers[c];
    } else {
      for (int c = 0; c < 3; ++c) at(row, c) += value[c];
    }
  }

  Byte* base() const { return base_; }
  std::size_t stride() const { return stride_; }
  std::size_t plane() const { return plane_; }

 private:
  Byte* base_ = nullptr;
  std::size_t stride_ = 0;
  std::size_t plane_ = 0;
};

}  // namespace beadwork

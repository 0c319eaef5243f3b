#pragma once
// Numbers that a run remembers: each stands in a row of a column of the scene, so that a checkpoint has it and a resume
// finds it again.

#include <string>

#include "core/domain/table.hpp"

namespace beadwork {

/// One of them. Until it is given a place it is a number of its own; a copy shares the place.
class Kept {
 public:
  Kept() = default;
  /// Takes its place in the column of this name, which is made if need be. Throws std::logic_error if there is another
  /// of that name.
  Kept(Table& table, std::string name, std::string unit, std::string doc, Index row = 0) {
    stand_in(table, std::move(name), std::move(unit), std::move(doc), row);
  }
  Kept(const Kept&) = default;
  Kept& operator=(const Kept&) = delete;  // the place, or the number?
  Kept& operator=(Real value) {
    number() = value;
    return *this;
  }
  Kept& operator+=(Real value) { return *this = number() + value; }
  operator Real() const { return column_ ? there() : own_; }

  /// Gives it a place, with what stands there.
  void stand_in(Table& table, std::string name, std::string unit, std::string doc, Index row = 0) {
    column_ = &table.add({std::move(name), On::scene, Type::real, std::move(unit), std::move(doc), ""});
    column_->keep();
    row_ = row;
  }

 private:
  // The column's type has been checked when it was made; where it lies is asked anew, for it may have moved.
  Real& there() const { return View<Real>(column_->base(), column_->stride(), column_->plane())[row_]; }
  Real& number() { return column_ ? there() : own_; }
  Column* column_ = nullptr;
  Index row_ = 0;
  Real own_ = 0;
};

}  // namespace beadwork

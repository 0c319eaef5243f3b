#pragma once
// What a plugin touches: four verbs. Nothing that no plugin of the scene declares is allocated, computed or saved.

#include <type_traits>

#include "core/domain/domain.hpp"

namespace beadwork {

class Plugin;

enum class Verb {
  reads,   ///< must be given by somebody: filled, kept, written or derived
  adds,    ///< adds to a sum that the core clears at each evaluation
  writes,  ///< offers: the column exists only if somebody reads it
  keeps,   ///< state: saved in checkpoints, offered to every reader
};
const char* verb_name(Verb verb);

class FieldUse {
 public:
  FieldUse(Plugin* owner, Field field, Verb verb);
  virtual ~FieldUse() = default;
  FieldUse(const FieldUse&) = delete;
  FieldUse& operator=(const FieldUse&) = delete;

  const Field& field() const { return field_; }
  Verb verb() const { return verb_; }
  /// A use that the deck's choices make needless can be dropped in Plugin::choose.
  void want(bool wanted) { wanted_ = wanted; }
  bool wanted() const { return wanted_; }

  /// Points the view at the column; nullptr where nobody reads what is offered.
  virtual void bind(Column* column) = 0;

 private:
  Field field_;
  Verb verb_;
  bool wanted_ = true;
};

/// Name, place, unit and doc of a field of the plugin's own; its type follows from the use.
struct OwnField {
  std::string name;
  On on;
  std::string unit;
  std::string doc;
};

template <class T, Verb V>
class Use final : public FieldUse {
 public:
  Use(Plugin* owner, const Field& field) : FieldUse(owner, field, V) {}
  Use(Plugin* owner, const OwnField& own)
      : FieldUse(owner, {own.name, own.on, type_of<T>(), own.unit, own.doc, ""}, V) {}

  void bind(Column* column) override { view_ = column ? View<T>(column->view<std::remove_const_t<T>>()) : View<T>{}; }
  const View<T>& view() const { return view_; }
  explicit operator bool() const { return static_cast<bool>(view_); }
  decltype(auto) operator[](Index row) const { return view_[row]; }
  void set(Index row, const std::remove_const_t<T>& value) const { view_.set(row, value); }
  void add(Index row, const std::remove_const_t<T>& value) const { view_.add(row, value); }

 private:
  View<T> view_;
};

template <class T>
using Reads = Use<const T, Verb::reads>;
template <class T>
using Adds = Use<T, Verb::adds>;
template <class T>
using Writes = Use<T, Verb::writes>;
template <class T>
using Keeps = Use<T, Verb::keeps>;

}  // namespace beadwork

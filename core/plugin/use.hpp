#pragma once
// What a plugin touches: five verbs. Nothing that no plugin of the scene declares is allocated, computed or saved.

#include <span>
#include <type_traits>
#include <vector>

#include "core/domain/domain.hpp"

namespace beadwork {

class Plugin;

enum class Verb {
  reads,   ///< must be given by somebody: filled, kept, written or derived
  adds,    ///< adds to a sum that the core clears at each evaluation
  writes,  ///< offers: the column exists only if somebody reads it
  keeps,   ///< state: saved in checkpoints, offered to every reader
  sums,    ///< offers as a sum: adds to it in the steps in which somebody reads it, and the core clears it before
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

  /// What is offered is there even if nobody reads it.
  void always() { always_ = true; }
  bool is_always_there() const { return always_; }
  /// No other plugin means this field by that name: its column carries the plugin's id too.
  void own() { own_ = true; }
  bool is_own() const { return own_; }

  /// Points the view at the columns: one, or on bonds one for each of the plugin's families; nullptr where nobody reads
  /// what is offered.
  virtual void bind(std::span<Column* const> columns) = 0;
  /// Of several families: the one whose column is seen.
  virtual void turn_to(std::size_t family) = 0;

 private:
  Field field_;
  Verb verb_;
  bool wanted_ = true;
  bool always_ = false;
  bool own_ = false;
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

  void bind(std::span<Column* const> columns) override {
    views_.clear();
    for (Column* column : columns)
      views_.push_back(column ? View<T>(column->view<std::remove_const_t<T>>()) : View<T>{});
    view_ = views_.empty() ? View<T>{} : views_.front();
  }
  void turn_to(std::size_t family) override { view_ = family < views_.size() ? views_[family] : View<T>{}; }
  const View<T>& view() const { return view_; }
  explicit operator bool() const { return static_cast<bool>(view_); }
  decltype(auto) operator[](Index row) const { return view_[row]; }
  void set(Index row, const std::remove_const_t<T>& value) const { view_.set(row, value); }
  void add(Index row, const std::remove_const_t<T>& value) const { view_.add(row, value); }

 private:
  View<T> view_;
  std::vector<View<T>> views_;  ///< by family
};

template <class T>
using Reads = Use<const T, Verb::reads>;
template <class T>
using Adds = Use<T, Verb::adds>;
template <class T>
using Writes = Use<T, Verb::writes>;
template <class T>
using Keeps = Use<T, Verb::keeps>;
template <class T>
using Sums = Use<T, Verb::sums>;

}  // namespace beadwork

#pragma once
// A value that the deck gives a plugin. One declaration serves parsing, checking, documentation and the XSD.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/complaints.hpp"
#include "core/base/types.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/expression.hpp"

namespace beadwork {

class Plugin;

struct Range {
  Real low = -std::numeric_limits<Real>::infinity();
  Real high = std::numeric_limits<Real>::infinity();
  bool without_low = false;   ///< `low` itself is outside
  bool without_high = false;  ///< `high` itself is outside

  bool holds(Real value) const {
    return (without_low ? value > low : value >= low) && (without_high ? value < high : value <= high);
  }
  /// In words, for values of that unit: "> 0 Pa".
  std::string text(const std::string& unit) const;
};

inline constexpr Range anything{};
inline constexpr Range positive{0, std::numeric_limits<Real>::infinity(), true, false};
inline constexpr Range not_negative{0};
inline constexpr Range fraction{0, 1};

/// What a text of the deck stands for, so that names can be checked against one another, and that files are there.
enum class Role { plain, makes_set, set, makes_family, family, fields, file };

/// Whether a parameter trades speed for accuracy while it leaves the physics as it is, and which way is faster.
enum class Knob { none, larger_is_faster, smaller_is_faster, a_choice };

struct ParamInfo {
  std::string name;
  std::string unit = "1";  ///< of quantities; "1" is a plain number
  Range range = anything;  ///< in SI
  std::string doc;
  std::optional<std::string> fallback = std::nullopt;  ///< used when the deck is silent, read as if it stood there
  bool optional = false;                               ///< may be absent without a fallback: ask `given()`
  std::vector<std::string> choices = {};               ///< of a text: one of these
  Role role = Role::plain;
  Knob knob = Knob::none;                 ///< `trade` tries values of these
  int count = 0;                          ///< of several words: how many are wanted; 0 is any number
  std::vector<Variable> variables = {};   ///< of a formula
  std::vector<std::string> columns = {};  ///< of rows: the unit of each column
  std::string instead = {};  ///< an attribute that may stand in place of this one: with it there is no fallback
  std::string one_of = {};   ///< of the parameters that name one such group, exactly one is to be given
};

/// QuantityRows of quantities, such as `0 s 0 m/s, 1 ms 2 m/s`, in SI.
using QuantityRows = std::vector<std::vector<Real>>;

/// A formula on quantities, such as `x < 13.5 mm`.
struct Formula {
  std::optional<Expression> expression;
  std::string text;  ///< as it stands in the deck
  Real operator()(std::span<const Real> values) const { return expression->evaluate(values); }
};

class ParamBase {
 public:
  ParamBase(Plugin* owner, ParamInfo info);
  virtual ~ParamBase() = default;
  ParamBase(const ParamBase&) = delete;
  ParamBase& operator=(const ParamBase&) = delete;

  const ParamInfo& info() const { return info_; }
  /// True if the deck or a fallback gave a value.
  bool given() const { return given_; }
  /// True if the deck itself gave it.
  bool in_deck() const { return in_deck_; }
  const Location& at() const { return at_; }
  /// Where this word of the value stands; where the value does not hold it literally, the value.
  Location at(const std::string& word) const;
  bool needed() const { return !info_.optional && !info_.fallback && info_.one_of.empty(); }

  void read(const Attribute& attribute, const Scope& scope, Complaints& complaints);
  void read_fallback(const Location& at, const Scope& scope, Complaints& complaints);

  virtual std::string type() const = 0;  ///< in words, for the manual
  virtual std::string text()
      const = 0;  ///< the value in SI, as any deck may give it: without parameters, paths absolute
  /// The names it holds, if its role is one of names.
  virtual std::vector<std::string> names() const { return {}; }

 protected:
  virtual bool take(const Attribute& attribute, const Scope& scope, Complaints& complaints) = 0;

 private:
  ParamInfo info_;
  bool given_ = false;
  bool in_deck_ = false;
  Location at_;
  std::string written_;  ///< the value as it stands in the deck
};

/// T is Real, Vec3, std::int64_t, bool, std::string, std::vector<std::string>, QuantityRows or Formula. A text whose
/// role is that of a file becomes a path that can be opened.
template <class T>
class Param final : public ParamBase {
 public:
  using ParamBase::ParamBase;
  const T& value() const { return value_; }
  const T& operator*() const { return value_; }
  const T* operator->() const { return &value_; }
  operator const T&() const { return value_; }

  std::string type() const override;
  std::string text() const override;
  std::vector<std::string> names() const override;

 private:
  bool take(const Attribute& attribute, const Scope& scope, Complaints& complaints) override;
  T value_{};
};

extern template class Param<Real>;
extern template class Param<Vec3>;
extern template class Param<std::int64_t>;
extern template class Param<bool>;
extern template class Param<std::string>;
extern template class Param<std::vector<std::string>>;
extern template class Param<QuantityRows>;
extern template class Param<Formula>;

}  // namespace beadwork

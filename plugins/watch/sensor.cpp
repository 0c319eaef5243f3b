#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// One number of a field: its sum, mean, extremes or the like over a set, the bonds of a family, or all there are.
class Sensor final : public Watcher, private Gauge {
 public:
  static constexpr const char* about =
      "Any field reduced to a number, over a set, the bonds of a family or all, as a curve";
  Param<std::vector<std::string>> field{
      this, {.name = "field", .doc = "Name of the field, of elements or of bonds", .role = Role::fields, .count = 1}};
  Param<std::string> component{this,
                               {.name = "component",
                                .doc = "Of a vector: x, y, z or its size; of a symmetric tensor: xx, xy, xz, yy, yz, "
                                       "zz or mean, a third of its trace; "
                                       "the size of a vector and the mean of a tensor where absent",
                                .optional = true,
                                .choices = {"x", "y", "z", "size", "xx", "xy", "xz", "yy", "yz", "zz", "mean"}}};
  Param<std::string> reduce{this,
                            {.name = "reduce",
                             .doc = "What is told of all values; count: how many there are, or how many fulfil 'where'",
                             .fallback = "mean",
                             .choices = {"sum", "mean", "min", "max", "rms", "count"}}};
  Param<std::string> set{this,
                         {.name = "set",
                          .doc = "Set of elements that is looked at; all but walls where absent",
                          .optional = true,
                          .role = Role::set}};
  Param<std::string> bonds{
      this,
      {.name = "bonds",
       .doc = "Family of bonds or contacts that is looked at; all that have the field where absent",
       .optional = true,
       .role = Role::family}};
  Param<Formula> where{
      this,
      {.name = "where",
       .unit = "",
       .doc = "Only values that fulfil this condition on 'value', which is in SI units, as a plain number",
       .optional = true,
       .variables = {{"value", {}}}}};
  Param<std::string> name{this,
                          {.name = "name",
                           .doc = "Name of the curve and of its file, and in until=\"sensor NAME > VALUE\"",
                           .fallback = "sensor"}};
  Curve curve{this, name, {}};
  Keeps<Real> told{this, {"told", On::scene, "1", "What it told at its last look, in SI units"}};

  const Gauge* gauge() const override { return this; }

  std::vector<std::string> families() const override {
    return bonds.given() ? std::vector<std::string>{*bonds} : std::vector<std::string>{};
  }

  void check(Complaints& complaints) const override {
    if (set.given() && bonds.given())
      complaints.error(bonds.at(), "'set' is of elements, 'bonds' of bonds: a sensor looks at one of them");
  }

  void choose() override {
    const std::string over = set.given() ? *set : bonds.given() ? *bonds : "all";
    curve.plan.columns = {{*reduce, *reduce == "count" ? "1" : ""}};  // the unit of the field is seen at the first look
    curve.plan.title = fmt::format("{}: {} over {}", field->front(), *reduce, over);
    curve.plan.y = {*reduce};
  }

  void look(Sight& sight) override {
    values_.clear();
    unit_ = "1";
    gather(sight.domain());
    if (where.given()) std::erase_if(values_, [&](Real value) { return (*where)({&value, 1}) != 1; });
    told[0] = reduced();
    if (*reduce != "count") curve.plan.columns.front().second = unit_;
    curve.row({told[0]});
  }

 private:
  Real last() const override { return told[0]; }
  std::string unit(const Domain& domain) const override {
    if (*reduce == "count") return "1";
    if (const Column* column = domain.elements().find(field->front()); column && !bonds.given())
      return column->field().unit;
    for (const BondTable* table : domain.families())
      if (const Column* column = table->rows().find(field->front());
          column && (!bonds.given() || table->name() == *bonds))
        return column->field().unit;
    return "1";
  }
  void gather(const Domain& domain) {
    if (!bonds.given()) {
      if (const Column* column = domain.elements().find(field->front())) return take_elements(domain, *column);
      if (set.given())
        refuse(field.at(), fmt::format("'{}' is no field of elements, and 'set' is of these", field->front()));
    }
    bool found = false;
    for (const BondTable* table : domain.families()) {
      if (bonds.given() && table->name() != *bonds) continue;
      const Column* column = table->rows().find(field->front());
      if (!column) continue;
      found = true;
      unit_ = column->field().unit;
      for (const Chunk& chunk : table->chunks())
        for (Index row = chunk.begin; row < chunk.live_end; ++row) take(*column, row);
    }
    if (!found)
      refuse(field.at(), fmt::format("'{}' is no field of bonds{}", field->front(),
                                     bonds.given() ? fmt::format(" of '{}'", *bonds) : ""));
  }
  void take_elements(const Domain& domain, const Column& column) {
    unit_ = column.field().unit;
    if (set.given())
      for (const Index row : domain.set(*set)) take(column, row);
    else
      for (Index row = 0; row < domain.size(); ++row)
        if (!domain.walls().is_wall(row)) take(column, row);
  }

  void take(const Column& column, Index row) {
    switch (column.field().type) {
      case Type::real: require({}); return values_.push_back(column.view<Real>()[row]);
      case Type::index: require({}); return values_.push_back(static_cast<Real>(column.view<Index>()[row]));
      case Type::state: require({}); return values_.push_back(static_cast<Real>(column.view<State>()[row]));
      case Type::vec3: {
        require({"x", "y", "z", "size"});
        const Vec3 v = column.view<Vec3>()[row];
        const std::string which = component.given() ? *component : "size";
        return values_.push_back(which == "size" ? v.norm() : v[which[0] - 'x']);
      }
      case Type::sym3: {
        require({"xx", "xy", "xz", "yy", "yz", "zz", "mean"});
        const Sym3 s = column.view<Sym3>()[row];
        const std::string which = component.given() ? *component : "mean";
        if (which == "mean") return values_.push_back((s.xx + s.yy + s.zz) / 3);
        const std::array<std::pair<const char*, Real>, 6> all{
            {{"xx", s.xx}, {"xy", s.xy}, {"xz", s.xz}, {"yy", s.yy}, {"yz", s.yz}, {"zz", s.zz}}};
        return values_.push_back(
            std::find_if(all.begin(), all.end(), [&](const auto& each) { return which == each.first; })->second);
      }
      case Type::quat:
        refuse(field.at(), fmt::format("'{}' is a field of turns, of which no number is made", field->front()));
    }
  }

  void require(std::vector<std::string> known) const {
    if (!component.given() || std::find(known.begin(), known.end(), *component) != known.end()) return;
    refuse(component.at(), known.empty() ? fmt::format("'{}' has no components", field->front())
                                         : fmt::format("'{}' has the components {}", field->front(), join(known)));
  }

  // In the order of the rows. Of nothing the sum is 0, and so is all else.
  Real reduced() const {
    const auto count = static_cast<Real>(values_.size());
    if (*reduce == "count") return count;
    if (values_.empty()) return 0;
    if (*reduce == "min") return *std::min_element(values_.begin(), values_.end());
    if (*reduce == "max") return *std::max_element(values_.begin(), values_.end());
    Real sum = 0;
    for (const Real value : values_) sum += *reduce == "rms" ? value * value : value;
    return *reduce == "sum" ? sum : *reduce == "mean" ? sum / count : std::sqrt(sum / count);
  }

  std::vector<Real> values_;
  std::string unit_ = "1";
};

}  // namespace beadwork

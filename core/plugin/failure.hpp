#pragma once
// Section <fail>: judges what may break. What then falls is the core's affair.

#include "core/base/parallel.hpp"
#include "core/plugin/plugin.hpp"

namespace beadwork {

class Failure : public Plugin {
 public:
  static constexpr Kind its_kind = Kind::fail;
  Param<std::vector<std::string>> of{
      this, {.name = "of", .doc = "Families of the bonds that may break", .role = Role::family}};
  Param<std::int64_t> every{this,
                            {.name = "every",
                             .range = {1},
                             .doc = "Steps from one check to the next",
                             .fallback = "1",
                             .knob = Knob::larger_is_faster}};
  Param<std::vector<std::string>> except{
      this,
      {.name = "except",
       .doc = "Sets whose elements never fail, nor bonds between two of them: unbreakable bands",
       .optional = true,
       .role = Role::set}};
  /// What the criterion finds over its threshold, on the bonds of its families or on the elements. From 1 on a bond
  /// breaks, or an element loses all its bonds of these families.
  Writes<Real> utilisation;

  std::vector<std::string> families() const override { return *of; }
  bool judges_elements() const { return utilisation.field().on == On::elements; }

  /// When the first stage in which it stands begins, and when bonds of one of its families are made later: draws what is
  /// random and has not been drawn.
  virtual void begin(const Domain&, std::uint64_t /*seed*/) {}
  /// When the bonds of one of its families have just been made: rows of those that are broken from the start.
  virtual std::vector<Index> flaws(const Domain&, const BondTable&, std::uint64_t /*seed*/) { return {}; }
  /// False for one that has flaws and nothing else: it never judges.
  virtual bool judges() const { return true; }
  /// Fills the utilisation of each live bond, or of each element. Also called at other steps than those of `every`, for
  /// those who want to see utilisations; then nothing breaks. All criteria see one configuration.
  virtual void judge(const Domain& domain) = 0;
  /// Name of the way in which bonds break, for the log.
  virtual std::string mode() const = 0;

  /// Told at the start of a stage: which elements are in the sets of 'except'.
  void note_spared(const Domain& domain);
  bool spares_some() const { return !spared_.empty(); }
  /// To be asked only where it spares some.
  bool spares(Index element) const { return spared_[static_cast<std::size_t>(element)]; }
  bool spares(const BondTable& table, Index row) const {
    return spares(table.first()[row]) && spares(table.second()[row]);
  }

 protected:
  explicit Failure(On judged = On::bonds);

  /// f(row) is the utilisation of a bond of the family whose columns are seen; the threads share the pass.
  template <class F>
  void judge_bonds(const Domain& domain, const F& f) {
    each_family(domain, [&](const BondTable& table) {
      each_shared(static_cast<Index>(table.chunks().size()), [&](Index c) {
        const Chunk& chunk = table.chunks()[static_cast<std::size_t>(c)];
        for (Index b = chunk.begin; b < chunk.live_end; ++b) utilisation[b] = used(f(b));
      });
    });
  }
  /// f(row) is the utilisation of an element.
  template <class F>
  void judge_elements(const Domain& domain, const F& f) const {
    each_shared(
        domain.size(), [&](Index i) { utilisation[i] = used(f(i)); }, 1024);
  }

 private:
  /// What is pushed where only pulling breaks is not used at all. What is no number stays what it is, to be noticed.
  static Real used(Real found) { return found < 0 ? 0 : found; }
  std::vector<char> spared_;  ///< of each element; empty where there is no 'except'
};

}  // namespace beadwork

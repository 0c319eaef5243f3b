#include <fmt/format.h>

#include "plugins/study/chosen_runs.hpp"

namespace beadwork {

/// Holds a number that runs of the study have found beside what was printed.   docs/batch.md
class Claim final : public Study {
 public:
  static constexpr const char* about = "Holds a number that runs have found beside one that was printed, and its band";
  Param<std::string> name{this, {.name = "name", .doc = "By which it is known, such as S2"}};
  Param<std::string> says{this, {.name = "says", .doc = "What is claimed, in words"}};
  Param<std::string> source{this, {.name = "source", .doc = "Where it is printed", .optional = true}};
  Param<std::string> of{this, {.name = "of", .doc = "The sweep whose runs it is read from"}};
  Param<std::string> where{this,
                           {.name = "where",
                            .doc = "Which of its runs: \"deck = fine; ratio = 2, 0.5\". All where absent",
                            .optional = true}};
  Param<std::string> curve{this, {.name = "curve", .doc = "The curve it is read from", .one_of = "source of numbers"}};
  Param<std::string> column{this,
                            {.name = "column",
                             .doc = "The column of batch.csv that holds it, without its unit",
                             .one_of = "source of numbers"}};
  Param<std::string> read{
      this,
      {.name = "read", .doc = "What is read: \"largest force\", \"force at displacement 1 mm\"", .optional = true}};
  Param<std::string> over{
      this,
      {.name = "over", .doc = "What it is divided by, read from the same curve of the same run", .optional = true}};
  Param<std::string> beside{
      this,
      {.name = "beside",
       .doc = "Runs of the same sweep, with the same seeds, whose number it is divided by: \"deck "
              "= sound\"",
       .optional = true}};
  Param<std::string> times{this, {.name = "times", .doc = "A factor, such as 2 or \"71.4 1/mm\"", .optional = true}};
  Param<std::string> printed{this, {.name = "printed", .doc = "What is printed: \"42 mN\"", .optional = true}};
  Param<std::string> from{this, {.name = "from", .doc = "Least number that agrees", .optional = true}};
  Param<std::string> to{this, {.name = "to", .doc = "Largest number that agrees", .optional = true}};

  void check(Complaints& complaints) const override {
    sweeps::understand_clauses(where, complaints);
    sweeps::understand_clauses(beside, complaints);
    for (const Param<std::string>* each : {&times, &from, &to})
      if (each->given() && !parse_amount(**each))
        complaints.error(each->at(), fmt::format("'{}' wants a number with its unit, such as 30 mN, got \"{}\"",
                                                 each->info().name, **each));
    if (curve.given() && curve->find('/') != std::string::npos)
      complaints.error(curve.at(), "'curve' wants the name of a curve, such as force, and no path");
    check_reading(read, complaints);
    check_reading(over, complaints);
    if (curve.given() && !read.given()) complaints.error(curve.at(), "'curve' wants 'read': what is read from it");
    for (const Param<std::string>* each : {&read, &over})
      if (column.given() && each->given())
        complaints.error(each->at(),
                         fmt::format("'{}' is read from a 'curve', and a 'column' has one number", each->info().name));
    if (!from.given() || !to.given() || complaints.errors() > 0) return;
    const Amount low = *parse_amount(*from), high = *parse_amount(*to);
    if (!(low.unit.dimension == high.unit.dimension) || low.quantity().value > high.quantity().value)
      complaints.error(to.at(), fmt::format("the band from \"{}\" to \"{}\" holds no number", *from, *to));
  }

  bool is_of_batch() const override { return true; }
  void add_to(BatchPlan& plan) const override {
    ClaimPlan claim;
    claim.name = *name;
    claim.says = *says;
    claim.of = {*of, {}, at()};
    if (source.given()) claim.source = *source;
    if (printed.given()) claim.printed = *printed;
    if (where.given()) claim.of.where = sweeps::wanted_of(*where);
    if (curve.given()) {
      claim.curve = *curve;
      claim.reading = *parse_reading(*read);
    } else {
      claim.column = *column;
    }
    if (over.given()) claim.over = parse_reading(*over);
    if (beside.given()) claim.beside = ChosenRuns{*of, sweeps::wanted_of(*beside), beside.at()};
    if (times.given()) claim.times = parse_amount(*times);
    if (from.given()) claim.from = parse_amount(*from);
    if (to.given()) claim.to = parse_amount(*to);
    plan.claims.push_back(std::move(claim));
  }

 private:
  static void check_reading(const Param<std::string>& text, Complaints& complaints) {
    if (text.given() && !parse_reading(*text))
      complaints.error(text.at(),
                       fmt::format("'{}' wants one of {}, got \"{}\"", text.info().name, reading_phrases, *text));
  }
};

}  // namespace beadwork

#include "plugins/study/chosen_runs.hpp"

namespace beadwork {

/// Shows runs of the study together in its report.   docs/batch.md
class Figure final : public Study {
 public:
  static constexpr const char* about =
      "Lays curves of runs over one another, or shows pictures of one, in the report of the study";
  Param<std::string> name{this, {.name = "name", .doc = "By which it is known, such as Fig 20b"}};
  Param<std::string> says{this, {.name = "says", .doc = "What it shows, in words"}};
  Param<std::string> of{this, {.name = "of", .doc = "The sweep whose runs it shows"}};
  Param<std::string> where{this,
                           {.name = "where",
                            .doc = "Which of its runs: \"deck = fine, coarse; seed = 1\". All where absent",
                            .optional = true}};
  Param<std::string> curve{this, {.name = "curve", .doc = "Name of the curve", .one_of = "what is shown"}};
  Param<bool> pictures{this,
                       {.name = "pictures", .doc = "Shows the pictures of the specimen", .one_of = "what is shown"}};

  void check(Complaints& complaints) const override {
    sweeps::understand_clauses(where, complaints);
    if (pictures.given() && !*pictures)
      complaints.error(pictures.at(), "a figure without pictures shows a 'curve': name it instead");
  }
  bool is_of_batch() const override { return true; }
  void add_to(BatchPlan& plan) const override {
    FigurePlan figure{*name, *says, {*of, {}, at()}, curve.given() ? *curve : ""};
    if (where.given()) figure.of.where = sweeps::wanted_of(*where);
    plan.figures.push_back(std::move(figure));
  }
};

}  // namespace beadwork

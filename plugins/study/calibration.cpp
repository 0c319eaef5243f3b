#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/plugin/kinds.hpp"
#include "plugins/study/calibration_work.hpp"

namespace beadwork {

/// The parameters of bonds whose solid has the stiffness and strength that are wanted.   docs/theory/calibration.md
class Calibration final : public Study {
 public:
  static constexpr const char* about =
      "Finds radius ratio, Young's modulus and strengths of the bonds of a solid with a wanted stiffness and strength";
  Param<std::string> name{
      this, {.name = "name", .doc = "Name of the material, and of its file of parameters NAME.calibration.xml"}};
  Param<Real> young{
      this, {.name = "young", .unit = "Pa", .range = positive, .doc = "Young's modulus of the solid that is wanted"}};
  Param<Real> poisson{this,
                      {.name = "poisson", .range = {-1, 1}, .doc = "Poisson's ratio of the solid that is wanted"}};
  Param<Real> strength{this,
                       {.name = "strength",
                        .unit = "Pa",
                        .range = positive,
                        .doc = "Largest stress in tension that is wanted; where absent no strengths are looked for",
                        .optional = true}};
  Param<Real> density{this,
                      {.name = "density",
                       .unit = "kg/m^3",
                       .range = positive,
                       .doc = "Density of the solid; that of the elements follows",
                       .optional = true}};
  Param<std::string> shape{
      this, {.name = "shape", .doc = "Of the samples", .fallback = "box", .choices = {"box", "cylinder"}}};
  Param<std::int64_t> elements{
      this,
      {.name = "elements", .range = {1}, .doc = "Of a sample", .fallback = "5000", .knob = Knob::smaller_is_faster}};
  Param<std::int64_t> seeds{this,
                            {.name = "seeds",
                             .range = {1, 1000},
                             .doc = "Number of samples, with seeds 'first-seed' and those behind it",
                             .fallback = "3",
                             .knob = Knob::smaller_is_faster}};
  Param<std::int64_t> first_seed{
      this, {.name = "first-seed", .range = {0}, .doc = "Seed of the first sample", .fallback = "1"}};
  Param<Real> spread{this,
                     {.name = "spread",
                      .range = {0, 1, false, true},
                      .doc = "Largest deviation of a radius from the mean, over the mean",
                      .fallback = "0.25"}};
  Param<Real> coordination{this,
                           {.name = "coordination",
                            .range = positive,
                            .doc = "Mean number of contacts of the samples' elements",
                            .fallback = "6.2"}};
  Param<std::string> counted{this,
                             {.name = "counted",
                              .doc = "Whose contacts: of all elements, or of those farther than three mean radii from "
                                     "walls",
                              .fallback = "bulk",
                              .choices = {"all", "bulk"}}};
  Param<Real> bond_poisson{this,
                           {.name = "bond-poisson",
                            .range = {0, 0.5},
                            .doc = "Poisson's ratio of the bonds, on which that of the solid hardly depends",
                            .fallback = "0.3"}};
  Param<QuantityRows> ratios{this,
                             {.name = "radius-ratios",
                              .doc = "Radius ratios at which stiffness and Poisson's ratio are measured, joined by "
                                     "commas",
                              .fallback = "0.05, 0.1, 0.17, 0.25, 0.35, 0.5, 0.7, 0.9",
                              .columns = {"1"}}};
  Param<std::string> section{this,
                             {.name = "section",
                              .doc = "Of a sample, over which its force is a stress: to the centres of the outer "
                                     "elements, or to its outer faces",
                              .fallback = "centres",
                              .choices = {"centres", "faces"}}};
  Param<std::vector<std::string>> criteria{this,
                                           {.name = "criteria",
                                            .doc = "Criteria of failure whose strength is looked for: those of "
                                                   "<bond-stress> by their measures, and of <virial-stress>",
                                            .fallback = "bbf-axial-bending rdef",
                                            .choices = {"bbf-axial", "bbf-axial-bending", "bbf-principal", "rdef"}}};
  Param<std::vector<std::string>> tests{
      this,
      {.name = "tests",
       .doc = "What else the bonds that were found are put to, by statics: tension, which is always run, compression, "
              "bending, torsion; and wave, the speed of a wave along a rod, which takes longer",
       .fallback = "tension compression bending torsion",
       .choices = {"tension", "compression", "bending", "torsion", "wave"}}};
  Param<std::string> tested{
      this,
      {.name = "tested", .doc = "Samples that are put to 'tests'", .fallback = "first", .choices = {"first", "all"}}};
  Param<std::int64_t> rod_elements{this,
                                   {.name = "rod-elements",
                                    .range = {1},
                                    .doc = "Of the rod of the test wave; where absent as many as a sample has, and no "
                                           "fewer than make it 8 across",
                                    .optional = true}};
  Param<Real> slenderness{
      this,
      {.name = "slenderness",
       .range = {4, 50},
       .doc = "How often that rod is as long as it is wide: the front of the wave is as long as 0.4 "
              "of it, and a rod is to be thin to its waves",
       .fallback = "24"}};
  Param<std::string> by{
      this,
      {.name = "by",
       .doc = "Mover of the samples: static finds equilibria, and breaks one bond or element after the "
              "other; verlet pulls slowly, with inertia",
       .fallback = "static",
       .choices = {"static", "verlet"},
       .knob = Knob::a_choice}};

  Param<Real> within{
      this,
      {.name = "within",
       .range = {0, 0.5},
       .doc = "By statics, what comes so near, as a share, to breaking first breaks with it; 1e-6 is one "
              "after the other, more is faster",
       .fallback = "0.02",
       .knob = Knob::larger_is_faster}};

  void check(Complaints& complaints) const override {
    if (name.given() && !is_plain_name(*name))
      complaints.error(name.at(), fmt::format("'name' wants {}, got \"{}\"", plain_name, *name));
    check_size(complaints);
    check_rod(complaints);
    if (!ratios.given()) return;
    if (ratios->size() < 2) complaints.error(ratios.at(), "'radius-ratios' wants two radius ratios at least");
    for (const auto& row : *ratios)
      if (!(row[0] > 0 && row[0] <= 1))
        complaints.error(ratios.at(),
                         fmt::format("a radius ratio must be > 0 and <= 1, got {}", format_number(row[0])));
  }

  void conduct(const StudyDesk& desk) override {
    const calibration::Plan plan = this->plan();
    const calibration::Found found = calibration::Work(plan, desk, poisson.at()).all();
    write_curves(found, desk);
    desk.result(result_json(plan, found));
    const auto file = desk.write(*name + ".calibration.xml", calibration::parameters(plan, found, desk.provenance));
    desk.log.say(fmt::format("written: {}", file.string()));
  }

 private:
  static constexpr Real fewest_across_ = 6;

  Real slender() const { return calibration::slenderness(*shape == "cylinder"); }

  /// Elements across a box or a cylinder that is so many times as long as it is wide.
  Real across(std::int64_t count, Real times) const {
    return calibration::width_of(*shape == "cylinder", count, times) / 2e-3;
  }
  /// How many elements make it so wide.
  std::int64_t elements_for(Real wanted, Real times) const {
    const Real of_one = across(1, times);
    return static_cast<std::int64_t>(std::ceil(std::pow(wanted / of_one, 3) - 1e-6));
  }
  std::int64_t elements_of_rod() const {
    constexpr Real usual = 8;
    return rod_elements.given() ? *rod_elements : std::max(*elements, elements_for(usual, *slenderness));
  }
  bool tests_waves() const { return std::find(tests->begin(), tests->end(), "wave") != tests->end(); }

  void check_size(Complaints& complaints) const {
    if (!elements.given() || !shape.given() || across(*elements, slender()) >= fewest_across_) return;
    complaints.error(
        elements.at(),
        fmt::format("{} elements are {:.1f} across the {}, of which the walls spoil the outer ones: {} are "
                    "wanted at least, which are {} elements; 5000 are a good start",
                    *elements, across(*elements, slender()), *shape, fewest_across_,
                    elements_for(fewest_across_, slender())));
  }

  void check_rod(Complaints& complaints) const {
    if (!tests_waves() || !rod_elements.given() || !slenderness.given() || !shape.given() ||
        across(*rod_elements, *slenderness) >= fewest_across_)
      return;
    complaints.error(rod_elements.at(),
                     fmt::format("{} elements are {:.1f} across a rod that is {} times as long as it is wide: {} are "
                                 "wanted at least, which are {} elements; or a smaller 'slenderness'",
                                 *rod_elements, across(*rod_elements, *slenderness), format_number(*slenderness),
                                 fewest_across_, elements_for(fewest_across_, *slenderness)));
  }

  calibration::Plan plan() const {
    calibration::Plan plan;
    plan.material = {*name, *young, *poisson, {}, {}};
    if (strength.given()) plan.material.strength = *strength;
    if (density.given()) plan.material.density = *density;
    plan.decks = {*shape == "cylinder", *elements, *spread, *coordination, *counted, *by, *within};
    for (const auto& row : *ratios) plan.ratios.push_back(row[0]);
    plan.seeds = *seeds;
    plan.first_seed = *first_seed;
    plan.bond_poisson = *bond_poisson;
    plan.through_centres = *section == "centres";
    plan.criteria = *criteria;
    plan.tests = {tests->begin(), tests->end()};
    plan.all_are_tested = *tested == "all";
    plan.rod_elements = elements_of_rod();
    plan.slenderness = *slenderness;
    return plan;
  }
};

}  // namespace beadwork

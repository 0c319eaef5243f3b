// The report of a run: shows what is there, and lets no text of a deck become markup.

#include <fmt/format.h>

#include <cmath>

#include "core/base/failure.hpp"
#include "tests/support/reported_run.hpp"
#include "workbench/report/axes.hpp"
#include "workbench/report/chart.hpp"
#include "workbench/report/table.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(Report, shows_the_facts_with_their_units) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<span class=\"badge done\">done</span>"));
  EXPECT_THAT(html, HasSubstr("time 1 ms reached"));
  EXPECT_THAT(html, HasSubstr("21.5 million/s"));
  EXPECT_THAT(html, HasSubstr("1 min 23 s"));
  EXPECT_THAT(html, HasSubstr("1 × 10⁻⁵ s"));
  EXPECT_THAT(html, HasSubstr("<th>something new</th><td>4.25</td>"));  // a key that nobody foresaw
}

TEST_F(Report, has_a_green_badge_of_quality_only_where_it_is_good) {
  make_run();
  EXPECT_THAT(page(), Not(HasSubstr("Quality"))) << "a run of an earlier version has no such figures";
  const std::string before = read(folder / "summary.json");
  const auto with = [&](const std::string& verdict) {
    write(folder / "summary.json", R"({"quality": {"verdict": ")" + verdict +
                                       R"(", "remarks": ["too <fast>"], "kinetic_over_stored": 0.034,
      "free_motion": 2.5e-5, "free_bodies": [{"elements": 47, "free_to": ["move along x", "turn about z"]}]}, )" +
                                       before.substr(1));
    return page();
  };
  EXPECT_THAT(with("good"), HasSubstr("<span class=\"badge done\">quasi-static, in balance</span>"));
  for (const char* verdict : {"fair", "poor", "dynamic", "idle", "unheard-of"}) {
    const std::string html = with(verdict);
    EXPECT_EQ(html.find("badge done", html.find("badge done") + 1), std::string::npos) << verdict;
  }
  const std::string html = with("fair");
  EXPECT_THAT(html, HasSubstr("<td>3.4 %</td>"));
  EXPECT_THAT(html, HasSubstr("<td>25 µm</td>"));
  EXPECT_THAT(html, HasSubstr("<li>too &lt;fast&gt;</li>"));
  EXPECT_THAT(html, HasSubstr("<li>a body of 47 elements was free to move along x, turn about z</li>"));
}

TEST_F(Report, draws_the_curve_with_its_labels_units_and_reference) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<figcaption>Load</figcaption>"));
  EXPECT_THAT(html, HasSubstr(">displacement [µm]</text>"));
  EXPECT_THAT(html, HasSubstr(">force [N]</text>"));
  EXPECT_THAT(html, HasSubstr("Eq (10)"));
  EXPECT_THAT(html, HasSubstr("class=\"line s1 dashed\""));
  EXPECT_THAT(html, HasSubstr("displacement 200 µm  ·  force 60"));  // under the pointer
}

TEST_F(Report, pictures_say_at_which_loading_and_in_which_state_the_specimen_is) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<img src=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(html, HasSubstr("<b>displacement 200 µm</b>"));
  EXPECT_THAT(html, HasSubstr("4 elastic"));
  EXPECT_THAT(html, HasSubstr("1 softening"));
  EXPECT_THAT(html, HasSubstr("1 broken"));
  EXPECT_THAT(html, HasSubstr("Side view, x to the right, z up"));
  EXPECT_THAT(html, HasSubstr("true to scale"));
  EXPECT_THAT(html, HasSubstr("set lower"));
}

TEST_F(Report, the_ledger_names_its_residual) {
  make_run();
  EXPECT_THAT(
      page(),
      HasSubstr(
          "Residual over the largest energy: <b>1.00 %</b> at the end, 1.00 % at most"));  // derived: (2 - 1.98) / 2
}

TEST_F(Report, says_how_near_to_breaking_the_run_came_and_where) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<td>interface</td><td>axial-bending</td><td>0.8731</td><td>bond 3 between elements 3, "
                              "9, at (3, 0, 0.5) mm, step 80, 800 µs</td>"));
  EXPECT_THAT(html, HasSubstr("<td>&lt;i&gt;</td><td>axial</td><td>0</td><td>nothing was under load</td>"));
  EXPECT_THAT(html, HasSubstr("<td>resin glue</td><td>virial-hydrostatic</td><td>1.038</td><td>element 4, at (4, 0, 0) "
                              "mm, step 90, 900 µs</td>"));
}

TEST_F(Report, breaks_and_packing_are_there) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("1 bond broke, releasing 1 mJ."));
  EXPECT_THAT(html, HasSubstr("bonds broken so far"));
  EXPECT_THAT(html, HasSubstr("<th>packing density</th><td>61.5 %</td>"));
  EXPECT_THAT(html, HasSubstr("<title>100 to 200: 7</title>"));  // micrometres
}

TEST_F(Report, breaks_over_time_are_steps) {
  make_run();
  write(folder / "summary.json", R"({"status": "done", "time": 1e-3})");
  // One break at half of the time: level up to there, one up, level to the end of the run.
  const double middle = report::Axes::left + 0.5 * (report::Axes::width - report::Axes::left - report::Axes::right);
  EXPECT_THAT(page(), testing::ContainsRegex(fmt::format("L{0:.1f} [0-9.]+L{0:.1f} [0-9.]+L{1:.1f} ", middle,
                                                         report::Axes::width - report::Axes::right)));
}

TEST_F(Report, a_curve_of_a_held_set_is_drawn_against_time) {
  make_run();
  write(folder / "curves/force.csv",
        "step [1],time [s],displacement [m],force [N]\n0,0,0,0\n50,5e-4,0,30\n100,1e-3,0,60\n");
  write(folder / "curves/force.json", R"({"title": "Load", "x": "displacement", "y": ["force"]})");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr(">time [ms]</text>"));
  EXPECT_THAT(html, Not(HasSubstr(">displacement [m]</text>")));
}

TEST_F(Report, recorded_fields_are_drawn_with_their_colour_bar) {
  Domain domain;
  make_specimen(domain);
  BondTable& interface = *domain.find_family("interface");
  Column& pull = interface.rows().add({"pull", On::bonds, Type::real, "N", "Force", ""});
  Column& heat = domain.elements().add({"heat", On::elements, Type::real, "K", "Heat", ""});
  for (Index b = 0; b < 6; ++b) pull.view<Real>()[b] = b - 2;
  for (Index i = 0; i < 12; ++i) heat.view<Real>()[i] = i == 3 ? std::nan("") : 300;
  RunFolder run = RunFolder::fresh(folder, false);
  Recorder recorder = Recorder::fresh(run, {}, domain);
  FrameRequest request;
  request.elements = {&heat};
  request.bonds.push_back({&interface, "spring", {&pull}});
  request.view = "y";
  recorder.write({0, 0, 0}, request, domain);
  const std::string html = page();
  EXPECT_THAT(
      html,
      HasSubstr("<b>pull</b> of the bonds<div class=\"colorbar\"><span>−3</span>"));  // as far below zero as above
  EXPECT_THAT(html, HasSubstr("<span>3 N</span>"));
  EXPECT_THAT(html, HasSubstr("<b>heat</b>: 300 K everywhere; 1 value not a number."));
  EXPECT_THAT(html, HasSubstr("Seen along y, "));  // as the snapshot said
}

/// Of the specimen that one can turn: three blocks behind its section's head.
std::string without_own_scripts(std::string html) {
  const std::string end = "</script>";
  for (std::size_t at = html.find("<div id=\"turnable\""); at != std::string::npos;) {
    const std::size_t open = html.find("<script", at), section = html.find("</section>", at);
    if (open == std::string::npos || open > section) break;
    html.erase(open, html.find(end, open) + end.size() - open);
  }
  return html;
}

TEST_F(Report, text_of_the_deck_does_not_become_markup) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(without_own_scripts(html), Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<script>alert(1)")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(html, HasSubstr("<h1>small &lt;b&gt;&amp; bold</h1>"));
}

TEST_F(Report, needs_nothing_from_elsewhere) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(without_own_scripts(html), Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("src=\"/")));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
}

TEST_F(Report, the_same_run_gives_the_same_bytes) {
  make_run();
  const std::string once = page();
  EXPECT_EQ(once, page());
}

class BatchReport : public Report {
 protected:
  /// A table of runs k = 1, 2, ..., each with a curve of its own height.
  void make_batch(int runs) {
    std::string table = "run,k,status,steps\n";
    for (int k = 1; k <= runs; ++k) {
      const std::string name = fmt::format("k={}", k);
      table += fmt::format("{},{},done,2\n", name, k);
      write(folder / name / "summary.json", R"({"status": "done"})");
      write(folder / name / "curves/force.csv",
            fmt::format("step [1],time [s],force [N]\n0,0,0\n1,1,{0}\n2,{1},{0}\n", k * k, 1 + k));
    }
    write(folder / "batch.csv", table);
  }
  std::string page() { return read(write_batch_report(folder)); }
};

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(BatchReport, lays_the_curves_of_all_runs_over_one_another_each_with_its_label) {
  make_batch(9);
  const std::string html = page();
  EXPECT_EQ(count(html, "<figure class=\"chart\">"), 1);
  EXPECT_EQ(count(html, "<path class=\"line"), 9);
  for (int k = 1; k <= 9; ++k) EXPECT_EQ(count(html, fmt::format("</i>k = {}</span>", k)), 1) << k;
}

TEST_F(BatchReport, the_ninth_run_sets_the_scale_like_the_others) {
  make_batch(9);
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("line s0 dashed")) << "told from the first by its stroke";
  EXPECT_THAT(html, HasSubstr(">80</text>"));  // its force is 81 N
  EXPECT_THAT(html, HasSubstr(">10</text>"));  // and its time 10 s
  EXPECT_THAT(html, Not(HasSubstr("goes on to")));
}

TEST_F(BatchReport, reads_of_a_run_its_curves_only_and_says_which_run_lacks_what) {
  make_batch(3);
  write(folder / "k=1/run.h5", "this is not HDF5");
  write(folder / "k=2/curves/force.csv", "step [1],time [s],force [N]\n0,0,0\n1,1,5\n2,2");
  fs::remove_all(folder / "k=3");
  const std::string html = page();
  EXPECT_THAT(html, Not(HasSubstr("run.h5")));
  EXPECT_THAT(html, HasSubstr("<li>k = 2: In curves/force.csv, 1 row was cut off"));
  EXPECT_THAT(html, HasSubstr("<li>k = 3 has not begun.</li>"));
  EXPECT_EQ(count(html, "<path class=\"line"), 2);
}

TEST_F(BatchReport, a_name_that_no_folder_can_have_costs_no_other_run) {
  make_batch(2);
  write(folder / "batch.csv", read(folder / "batch.csv") + std::string(300, 'n') + ",3,done,2\n");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<li>k = 3 has not begun.</li>"));
  EXPECT_EQ(count(html, "<path class=\"line"), 2);
}

TEST_F(BatchReport, numbers_of_the_table_are_numbers_and_other_words_stay) {
  make_batch(2);
  write(folder / "batch.csv", "run,k,status,steps\nk=1,0x10,done,40000\nk=2,nan,done,2\n");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<td>0x10</td>"));
  EXPECT_THAT(html, HasSubstr("<td>nan</td>"));
  EXPECT_THAT(html, HasSubstr("<td>40\u202f000</td>"));
}

TEST_F(BatchReport, a_page_of_somebody_else_is_left_alone) {
  make_batch(1);
  write(folder / "report.html", "mine");
  EXPECT_THROW(page(), DeckFailure);
  EXPECT_EQ(read(folder / "report.html"), "mine");
}

TEST(ReportTable, a_heading_has_a_name_and_a_unit) {
  const report::Table table = report::parse_table("force of left [N],ratio\n1,2\nnan,\n");
  EXPECT_EQ(table.columns[0].name, "force of left");
  EXPECT_EQ(table.columns[0].unit, "N");
  EXPECT_EQ(table.columns[1].unit, "1");
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.dropped_rows, 0);
}

TEST(ReportChart, a_reference_that_leaves_the_drawing_is_marked_with_how_far_it_goes) {
  report::Chart chart;
  chart.series.push_back({"force", {1, 2, 3}, {10, 11, 10}, 0, report::Stroke::solid});
  chart.series.push_back({"theory", {1, 2, 3}, {10, 500, 11}, 1, report::Stroke::dashed, true});
  EXPECT_THAT(report::figure(chart), HasSubstr("↑ theory goes on to 500"));
  chart.series.back().y = {10, 11, 10};
  EXPECT_THAT(report::figure(chart), Not(HasSubstr("goes on to")));
}

TEST(ReportChart, ticks_are_round_numbers) {
  EXPECT_THAT(report::ticks(0, 1.6, 8),
              testing::Pointwise(testing::DoubleNear(1e-12), {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6}));
  EXPECT_EQ(report::ticks(3, 3, 5).size(), 1U);
}

TEST(ReportChart, thinning_keeps_the_peak_and_the_ends) {
  std::vector<double> y(100000, 1);
  y[54321] = 9;
  y[12345] = -3;
  const auto rows = report::thinned(y, 900);
  EXPECT_LE(rows.size(), 1000U);
  EXPECT_THAT(rows, testing::AllOf(testing::Contains(54321U), testing::Contains(12345U), testing::Contains(99999U),
                                   testing::Contains(0U)));
}

TEST(ReportText, numbers_read_well) {
  EXPECT_EQ(report::number(0.23333), "0.2333");
  EXPECT_EQ(report::number(-5e-8), "−5 × 10⁻⁸");
  EXPECT_EQ(report::number(9.99996), "10");
  EXPECT_EQ(report::count(40000), "40\u202f000");
  EXPECT_EQ(report::duration(4000), "1 h 6 min");
  EXPECT_EQ(report::readable("m", 0.0016).unit, "mm");
  EXPECT_EQ(report::base64("beads", 5), "YmVhZHM=");
}

}  // namespace
}  // namespace beadwork

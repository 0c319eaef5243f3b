// The report of a run: shows what is there, says what is not, and lets no text of a deck become markup.
#include "workbench/report/report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/failure.hpp"
#include "core/domain/vocabulary.hpp"
#include "core/io/recorder.hpp"
#include "workbench/report/axes.hpp"
#include "workbench/report/chart.hpp"
#include "workbench/report/table.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

std::string read(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

/// Two layers of six elements, a cohesive interface between them, one bond of which has broken and one
/// softens.
void make_specimen(Domain& domain) {
  domain.add_elements(12);
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto radius = domain.elements().column("radius").view<Real>();
  for (Index i = 0; i < 12; ++i) {
    position.set(i, Vec3(i % 6 * 1e-3, 0, i < 6 ? 0 : 1e-3));
    radius[i] = 0.5e-3;
  }
  domain.sets()["lower"] = {0, 1, 2, 3, 4, 5};
  BondTable& interface = domain.add_family("interface");
  interface.create({{0, 6}, {1, 7}, {2, 8}, {3, 9}, {4, 10}, {5, 11}}, 0);
}

void record_frames(const fs::path& folder, Domain& domain) {
  RunFolder run = RunFolder::fresh(folder, false);
  RunMeta meta;
  meta.name = "in the record";
  Recorder recorder = Recorder::fresh(run, meta, domain);
  BondTable& interface = *domain.find_family("interface");
  FrameRequest request;
  request.bonds.push_back({&interface, "cohesive-contact", {}});
  recorder.write({0, 0, 0}, request, domain);
  interface.state()[0] = State::broken;
  interface.state()[1] = State::softening;
  domain.breaks().breaks.push_back({5e-4, 50, 0, 0, domain.breaks().mode("normal"), Vec3(0, 0, 5e-4), 1e-3});
  recorder.write({100, 1e-3, 0}, request, domain);
}

class Report : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("beadwork-report-" + std::to_string(getpid()));
    fs::remove_all(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  void make_run() {
    Domain domain;
    make_specimen(domain);
    record_frames(folder, domain);
    write(folder / "summary.json",
          R"({"name": "small <b>& bold", "status": "done", "exit_reason": "time 1 ms reached",
      "elements": 12, "bonds": {"interface": 6}, "steps": 100, "time_step": 1e-5, "wall_seconds": 83,
      "bond_updates_per_second": 21.5e6, "breaks": {"normal": 1}, "something_new": 4.25,
      "utilisation": {"fail.bond-stress": {"of": "interface", "mode": "axial-bending", "largest": 0.8731, "step": 80, "time": 8e-4,
                      "bond": 3, "elements": [3, 9], "place": [0.003, 0, 0.0005]},
                      "fail.bond-stress.2": {"of": "<i>", "mode": "axial", "largest": 0},
                      "fail.virial-stress": {"of": "resin glue", "mode": "virial-hydrostatic", "largest": 1.038, "step": 90,
                      "time": 9e-4, "element": 4, "place": [0.004, 0, 0]}},
      "packing": [{"density": 0.615, "radius_histogram": {"edges": [1e-4, 2e-4, 3e-4], "counts": [7, 5]}}]})");
    write(folder / "resolved.xml", "<scene name=\"small\"><fill/></scene><script>alert(1)</script>");
    write(folder / "run.log", "first line\nlast line\n");
    write(folder / "curves/force.csv",
          "step [1],time [s],displacement [m],force [N],reference Eq (10) [N]\n"
          "0,0,0,0,0\n50,5e-4,1e-4,30,31\n100,1e-3,2e-4,60,59\n");
    write(folder / "curves/force.json", R"({"title": "Load", "x": "displacement", "y": ["force"]})");
    write(folder / "curves/energy.csv",
          "step [1],time [s],external work [J],elastic [J],kinetic [J]\n0,0,0,0,0\n100,1e-3,2,1.5,0.48\n");
  }

  std::string page() { return read(write_report(folder)); }

  fs::path folder;
};

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

TEST_F(Report, text_of_the_deck_does_not_become_markup) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(html, HasSubstr("<h1>small &lt;b&gt;&amp; bold</h1>"));
}

TEST_F(Report, needs_nothing_from_elsewhere) {
  make_run();
  const std::string html = page();
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("src=\"/")));
}

TEST_F(Report, the_same_run_gives_the_same_bytes) {
  make_run();
  const std::string once = page();
  EXPECT_EQ(once, page());
}

TEST_F(Report, without_a_record_it_says_so_and_shows_the_rest) {
  make_run();
  fs::remove(folder / "run.h5");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("There is no run.h5, so there are no pictures"));
  EXPECT_THAT(html, HasSubstr("<figcaption>Load</figcaption>"));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
}

TEST_F(Report, a_damaged_record_is_told_from_a_missing_one) {
  make_run();
  write(folder / "run.h5", "this is not HDF5");
  EXPECT_THAT(page(), HasSubstr("run.h5 cannot be read"));
}

TEST_F(Report, a_frame_whose_file_is_lost_is_left_out) {
  make_run();
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(folder / "frames")) files.push_back(file);
  ASSERT_EQ(files.size(), 2U);
  fs::remove(std::min(files[0], files[1]));  // the first: displacements are then counted from the second
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("1 frame of run.h5 cannot be read"));
  EXPECT_THAT(html, HasSubstr("<img"));
}

TEST_F(Report, a_row_that_a_kill_cut_off_is_dropped_and_said) {
  make_run();
  write(folder / "curves/force.csv", "step [1],time [s],force [N]\n0,0,0\n1,1e-3,5\n2,2e-3,7");
  EXPECT_THAT(page(), HasSubstr("In curves/force.csv, 1 row was cut off"));
}

TEST_F(Report, a_run_that_was_killed_is_reported_from_what_it_had_written) {
  make_run();
  fs::remove(folder / "summary.json");
  fs::remove(folder / "resolved.xml");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("<span class=\"badge other\">unfinished</span>"));
  EXPECT_THAT(html, HasSubstr("it is still going on, or it was killed"));
  EXPECT_THAT(html, HasSubstr("<h1>in the record</h1>"));
  EXPECT_THAT(html, HasSubstr("<img"));
}

TEST_F(Report, an_interrupted_run_says_why_it_ended) {
  write(folder / "summary.json",
        R"({"status": "interrupted", "exit_reason": "SIGINT; resume with: beadwork run --resume"})");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("badge interrupted"));
  EXPECT_THAT(html, HasSubstr("resume with"));
  EXPECT_THAT(html, HasSubstr("There are no curves"));
}

TEST_F(Report, one_bad_number_is_left_out_and_the_rest_is_drawn) {
  make_run();
  write(folder / "curves/force.csv",
        "step [1],time [s],displacement [m],force "
        "[N]\n0,0,0,0\n50,5e-4,1e-4,nan\n60,6e-4,1.2e-4,1e308\n70,7e-4,1.4e-4,1e999\n100,1e-3,2e-4,60\n");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("In curves/force.csv, 3 numbers are infinite, undefined or too large to be drawn"));
  EXPECT_THAT(html, HasSubstr(">60</text>"));  // the axis is that of what is drawn
  EXPECT_THAT(html, Not(HasSubstr("10³⁰⁸")));
  EXPECT_THAT(html, HasSubstr("1 bond broke"));
}

TEST_F(Report, an_element_without_a_place_does_not_cost_the_picture) {
  for (const double bad : {std::nan(""), HUGE_VAL, 1e308, 1e30, 50.0}) {
    fs::remove_all(folder);
    {
      Domain domain;
      make_specimen(domain);
      domain.elements().column("position").view<Vec3>().set(3, Vec3(0, bad, 0));
      record_frames(folder, domain);
    }
    const std::string html = page();
    EXPECT_THAT(html, HasSubstr("In the frame of step 100, 1 element has no place or size that can be drawn")) << bad;
    EXPECT_THAT(html, HasSubstr("<img src=\"data:image/png;base64,iVBORw0KGgo")) << bad;
    EXPECT_THAT(html, HasSubstr("<b>1 mm</b></i>")) << bad;  // the scale bar of the specimen without it
  }
}

TEST_F(Report, what_cannot_be_read_costs_its_own_part_only) {
  make_run();
  write(folder / "summary.json", std::string(1000000, '['));
  write(folder / "curves/force.json", std::string(1000000, '['));
  fs::remove(folder / "run.log");
  fs::create_symlink("/etc/passwd", folder / "run.log");
  const std::string html = page();
  EXPECT_THAT(html, HasSubstr("summary.json is not readable as JSON"));
  EXPECT_THAT(html, HasSubstr("force.json is not readable as JSON"));
  EXPECT_THAT(html, HasSubstr("<li>run.log was left out: cannot read"));
  EXPECT_THAT(html, HasSubstr("it is a link"));
  EXPECT_THAT(html, Not(HasSubstr("root:")));
  EXPECT_THAT(html, HasSubstr("1 bond broke"));
}

TEST_F(Report, a_page_of_somebody_else_is_left_alone) {
  make_run();
  write(folder / "report.html", "mine");
  EXPECT_THROW(write_report(folder), DeckFailure);
  EXPECT_EQ(read(folder / "report.html"), "mine");
  fs::remove(folder / "report.html");
  write_report(folder);
  EXPECT_NO_THROW(write_report(folder));
}

TEST_F(Report, where_no_list_tells_whose_a_page_is_only_one_of_ours_is_replaced) {
  write(folder / "summary.json", R"({"status": "done"})");
  write(folder / "report.html", "mine");
  EXPECT_THROW(write_report(folder), DeckFailure);
  EXPECT_EQ(read(folder / "report.html"), "mine");
  fs::remove(folder / "report.html");
  fs::create_symlink("nowhere", folder / "report.html");
  EXPECT_THROW(write_report(folder), DeckFailure);
  fs::remove(folder / "report.html");
  write_report(folder);
  EXPECT_NO_THROW(write_report(folder));
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

TEST_F(Report, a_folder_that_is_no_run_is_refused) {
  EXPECT_THROW(write_report(folder), DeckFailure);
  fs::create_directories(folder);
  try {
    write_report(folder);
    FAIL();
  } catch (const DeckFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("is not the folder of a run"));
  }
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

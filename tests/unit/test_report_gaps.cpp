// The report of a run of which something is missing, damaged or not ours: it says so and shows the rest.

#include <cmath>

#include "core/base/failure.hpp"
#include "tests/support/reported_run.hpp"

namespace beadwork {
namespace {

using testing::HasSubstr;
using testing::Not;

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

}  // namespace
}  // namespace beadwork

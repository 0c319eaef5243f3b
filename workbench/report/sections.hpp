#pragma once
// The parts of the page, each made from what the run left; an empty text where there is nothing to show.

#include <string>
#include <vector>

#include "workbench/report/run_folder.hpp"

namespace beadwork::report {

std::string facts(const RunFolder&);
std::string curves(const RunFolder&, const std::vector<FrameHead>& pictured);
std::string ledger(const RunFolder&);
std::string breaks(const RunFolder&);
std::string packing(const RunFolder&);
std::string deck_and_log(const RunFolder&);

/// Pictures of the frames `pictured`; what cannot be read is added to the run's notes.
std::string pictures(RunFolder&, const std::vector<FrameHead>& pictured);

/// Those that the run flagged, else at most `most` spread evenly from the first to the last.
std::vector<FrameHead> frames_to_show(const RunFolder&, std::size_t most = 8);

/// "opening 0.29 mm", read from the first curve that is drawn against something other than time; else empty.
std::string loading_at(const RunFolder&, const FrameHead&);

bool is_ledger(const Curve&);
/// The row of the table nearest to the frame, by time or else by step.
std::size_t row_at(const Table&, const FrameHead&);

/// `<section id><h2>title</h2>body</section>`, or nothing if the body is empty.
std::string section(const std::string& title, const std::string& body);

/// Keys and values in two columns; nested objects become rows of their own.
std::string facts_table(const Json& object, const std::string& unit_of_numbers = "");

}  // namespace beadwork::report

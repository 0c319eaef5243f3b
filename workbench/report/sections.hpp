#pragma once
// The parts of the page, each made from what the run left; an empty text where there is nothing to show.

#include <string>
#include <vector>

#include "core/io/manifest.hpp"
#include "workbench/report/run.hpp"

namespace beadwork::report {

std::string facts(const Run&);
std::string curves(const Run&, const std::vector<record::FrameHead>& pictured);
std::string ledger(const Run&);
std::string utilisation(const Run&);
std::string breaks(const Run&);
std::string quality(const Run&);
std::string quality_badge(const Run&);
std::string packing(const Run&);
std::string deck_and_log(const Run&);

/// Of `law`: its result, a table for each family with the curves of this one, which are taken out of the run.
std::string laws(Run&, const Json& result);

/// The curves of one name of several runs, laid over one another in a chart for each unit. Each run has its label.
std::string overlaid(const std::vector<std::pair<std::string, const Curve*>>& of_runs);

/// Pictures of the frames `pictured`, seen along the axis `wanted` (x, y, z; empty: as the frames say, or as shows
/// most); what cannot be read is added to the run's notes.
std::string pictures(Run&, const std::vector<record::FrameHead>& pictured, const std::string& wanted);
/// The same without the specimen that one can turn, and without fields and heading.
std::string still_pictures(Run&, const std::vector<record::FrameHead>& pictured);
struct Stage;
/// What the frames recorded besides places, in colours with their bar.
std::string field_pictures(const Stage&, const std::vector<record::Frame>& frames);

/// Those that the run flagged, at most 24, else all, at most eight: spread evenly from the first to the last.
std::vector<record::FrameHead> chosen(const std::vector<record::FrameHead>& all);

/// "opening 0.29 mm", read from the first curve that is drawn against something other than time; else empty.
std::string loading_at(const Run&, const record::FrameHead&);

bool is_ledger(const Curve&);
/// The row of the table nearest to the frame, by time or else by step.
std::size_t row_at(const Table&, const record::FrameHead&);

/// Writes the page as report.html, which the list of the folder then names. DeckFailure if somebody else's page stands
/// there.
std::string put_page(const std::filesystem::path& folder, Manifest::Of of, const std::string& page);
/// Writes a page that stands on no list. DeckFailure if something else than a page of Beadwork stands there.
std::string put_page_at(const std::filesystem::path& file, const std::string& page);
/// The whole page; title and texts are HTML already.
std::string page_with(const std::string& title, const std::string& head, const std::string& body);
/// Of a status: the class decides the badge's colour; one that nobody foresaw is shown as it is, in grey.
std::string badge(const std::string& status);

/// `<section id><h2>title</h2>body</section>`, or nothing if the body is empty.
std::string section(const std::string& title, const std::string& body);

/// Keys and values in two columns; nested objects become rows of their own.
std::string facts_table(const Json& object, const std::string& unit_of_numbers = "");

}  // namespace beadwork::report

#include "workbench/report/report.hpp"

#include "core/io/file.hpp"
#include "workbench/report/page_style.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

namespace {

/// The class decides the badge's colour; a status that nobody foresaw is shown as it is, in grey.
std::string badge(const std::string& status) {
  const bool known = status == "done" || status == "failed" || status == "interrupted";
  return "<span class=\"badge " + std::string(known ? status : "other") + "\">" + escaped(status) + "</span>";
}

std::string header(const Run& run) {
  std::string out = "<h1>" + escaped(run.scene) + "</h1>" + badge(run.status) + quality_badge(run);
  const std::string reason = text_of(run.summary, "exit_reason");
  if (!reason.empty()) out += "<p>" + escaped(reason) + "</p>";
  return out;
}

std::string notes(const Run& run) {
  std::string items;
  for (const std::string& sentence : run.notes) items += "<li>" + escaped(sentence) + "</li>";
  return items.empty() ? "" : "<section class=\"notes\"><ul>" + items + "</ul></section>\n";
}

/// Replaces @name@ in the template. What is put in is not searched again, so a deck may hold @title@.
std::string filled(std::string_view page, const std::string& title, const std::string& head,
                   const std::string& body) {
  std::string out;
  while (!page.empty()) {
    const auto start = page.find('@');
    const auto end = page.find('@', start == std::string_view::npos ? start : start + 1);
    out += page.substr(0, start);
    if (end == std::string_view::npos) break;
    const std::string_view name = page.substr(start + 1, end - start - 1);
    if (name == "title") out += title;
    if (name == "style") out += page_style;
    if (name == "header") out += head;
    if (name == "body") out += body;
    page.remove_prefix(end + 1);
  }
  return out;
}

std::string page_of(Run& run) {
  const std::vector<record::FrameHead> shown =
      run.recorded ? chosen(run.recorded->frames()) : std::vector<record::FrameHead>{};
  const std::string seen = pictures(run, shown);  // first: it may add notes
  std::string body =
      facts(run) + curves(run, shown) + seen + quality(run) + ledger(run) + breaks(run) + packing(run) + deck_and_log(run);
  body = notes(run) + body;
  return filled(page_template, escaped(run.scene) + " – Beadwork", header(run), body);
}

}  // namespace
}  // namespace report

std::string write_report(const std::filesystem::path& run_folder) {
  report::Run run = report::open_run(run_folder);
  const std::filesystem::path file = run_folder / "report.html";
  write_atomically(file, report::page_of(run));
  return file.string();
}

}  // namespace beadwork

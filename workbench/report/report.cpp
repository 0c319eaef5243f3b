#include "workbench/report/report.hpp"

#include "core/base/failure.hpp"
#include "core/io/manifest.hpp"
#include "workbench/report/page_style.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"

namespace beadwork {
namespace report {

std::string badge(const std::string& status) {
  const bool known = status == "done" || status == "failed" || status == "interrupted";
  return "<span class=\"badge " + std::string(known ? status : "other") + "\">" + escaped(status) + "</span>";
}

namespace {

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

}  // namespace

// Replaces @name@ in the template. What is put in is not searched again, so a deck may hold @title@.
std::string page_with(const std::string& title, const std::string& head, const std::string& body) {
  std::string_view page = page_template;
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

namespace {

/// A part of the page; where it cannot be made, the page says so and has the others.
template <class Make>
std::string attempt(Run& run, const std::string& what, const Make& make) {
  try {
    return make();
  } catch (const std::exception& problem) {
    run.notes.push_back(what + " cannot be shown (" + problem.what() + ").");
    return "";
  }
}

std::string page_of(Run& run, const std::string& view) {
  const std::vector<record::FrameHead> shown =
      run.recorded ? chosen(run.recorded->frames()) : std::vector<record::FrameHead>{};
  std::string body = attempt(run, "The facts", [&] { return facts(run); });
  body += attempt(run, "The curves", [&] { return curves(run, shown); });
  body += attempt(run, "The pictures", [&] { return pictures(run, shown, view); });
  body += attempt(run, "The quality", [&] { return quality(run); });
  body += attempt(run, "The energy ledger", [&] { return ledger(run); });
  body += attempt(run, "The utilisation", [&] { return utilisation(run); });
  body += attempt(run, "The breaks", [&] { return breaks(run); });
  body += attempt(run, "The packing", [&] { return packing(run); });
  body += attempt(run, "Deck and log", [&] { return deck_and_log(run); });
  return page_with(escaped(run.scene) + " – Beadwork", header(run), notes(run) + body);
}

// A folder without a list may be one of an earlier version, or a copy: there a page of ours is known by what it says of
// itself.
bool is_ours(const std::filesystem::path& page) {
  constexpr std::uintmax_t longest = std::uintmax_t{1} << 31;
  try {
    return read_text(page, longest).find(maker_of_page) != std::string::npos;
  } catch (const MachineFailure&) {  // a link, a pipe
    return false;
  }
}

}  // namespace

std::string put_page(const std::filesystem::path& folder, Manifest::Of of, const std::string& page) {
  const std::filesystem::path file = folder / "report.html";
  auto list = Manifest::read(folder, of);
  if (!list) return put_page_at(file, page);
  list->claim("report.html");
  write_atomically(file, page);
  return file.string();
}

std::string put_page_at(const std::filesystem::path& file, const std::string& page) {
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, error)) && !is_ours(file))
    throw DeckFailure("'" + file.string() +
                      "' is there already, and is no report of Beadwork: it is left alone. Rename it");
  write_atomically(file, page);
  return file.string();
}

}  // namespace report

std::string write_report(const std::filesystem::path& run_folder, const std::string& view) {
  report::Run run = report::open_run(run_folder);
  const std::string page = report::page_of(run, view);
  return report::put_page(run_folder, Manifest::Of::run, page);
}

}  // namespace beadwork

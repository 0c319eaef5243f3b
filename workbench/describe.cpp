#include "workbench/describe.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

Manual manual_of(const Catalogue& catalogue) {
  Manual manual;
  for (const KindRow& row : all_kinds)
    for (const std::string& tag : catalogue.tags(row.kind))
      manual.push_back({row.kind, tag, catalogue.find(row.kind, tag)->about, catalogue.make(row.kind, tag)});
  return manual;
}

std::vector<const FieldUse*> Described::touched() const {
  std::vector<const FieldUse*> all;
  for (const FieldUse* use : plugin->uses())
    if (use->wanted()) all.push_back(use);
  return all;
}

Manual pick(Manual manual, const std::string& wanted) {
  std::vector<std::string> known;
  for (const Described& each : manual) {
    known.push_back(each.tag);
    known.push_back(each.path());
  }
  std::erase_if(manual, [&](const Described& each) { return each.tag != wanted && each.path() != wanted; });
  if (manual.empty()) throw DeckFailure(fmt::format("error: no plugin '{}'{}", wanted, did_you_mean(wanted, known)));
  return manual;
}

const char* use_word(Kind kind, Verb verb) {
  if (verb != Verb::writes) return verb_name(verb);
  return kind == Kind::fill ? "fills" : "offers";
}

std::string type_words(const ParamBase& param) {
  const std::string& unit = param.info().unit;
  const bool has_unit = unit != "1" && !unit.empty();
  return has_unit ? fmt::format("{} in {}", param.type(), unit) : param.type();
}

std::string range_words(const ParamBase& param) {
  const std::string words = param.info().range.text(param.info().unit);
  return words == "any" ? "" : words;
}

std::string presence_words(const Plugin& plugin, const ParamBase& param) {
  if (param.needed()) return "required";
  if (param.info().one_of.empty()) return "optional";
  std::vector<std::string> names;
  for (const ParamBase* member : plugin.one_of(param.info().one_of)) names.push_back(member->info().name);
  return "one of " + join(names);
}

std::string meaning(const ParamBase& param) {
  if (param.info().variables.empty()) return param.info().doc;
  std::vector<std::string> names;
  for (const Variable& variable : param.info().variables) names.push_back(variable.name);
  return fmt::format("{} (of {})", param.info().doc, join(names));
}

namespace {

struct DescribeArguments {
  std::string plugin, format;
  std::vector<std::string> libraries;
};

// Of what standard output is shown on; a hundred characters where it is no terminal.
std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 40) return 100;
  return std::min<std::size_t>(size.ws_col, 120);
}

int describe(const DescribeArguments& arguments) {
  Manual manual = manual_of(Catalogue::open({arguments.libraries.begin(), arguments.libraries.end()}));
  if (!arguments.plugin.empty()) manual = pick(std::move(manual), arguments.plugin);
  std::string text;
  if (arguments.format == "xsd")
    text = as_xsd(manual);
  else if (arguments.format == "json")
    text = as_json(manual);
  else if (arguments.format == "md")
    text = as_markdown(manual);
  else
    text = arguments.plugin.empty() ? as_list(manual, terminal_width()) : as_text(manual, terminal_width());
  write_out(text);
  return 0;
}

}  // namespace

void add_describe(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("describe", "Lists the plugins, or prints the manual of one or of all");
  verb->footer("Examples: beadwork describe cohesive-beam\n          beadwork describe --format xsd > beadwork.xsd");
  auto arguments = std::make_shared<DescribeArguments>();
  verb->add_option("plugin", arguments->plugin, "A plugin, such as bond/cohesive-beam or cohesive-beam");
  verb->add_option("--format", arguments->format,
                   "md: the manual as Markdown; xsd: a schema of decks for editors; json: the same as data; text for a "
                   "terminal where absent")
      ->check(CLI::IsMember({"md", "xsd", "json"}));
  verb->add_option("--plugins", arguments->libraries, "A plugin library, or a folder of them")->allow_extra_args(false);
  verb->callback([&chosen, arguments] { chosen = [arguments] { return describe(*arguments); }; });
}

}  // namespace beadwork
